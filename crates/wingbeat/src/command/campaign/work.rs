//! `wingbeat campaign work`: one worker, started by `wingbeat campaign run`.

use std::io::{Read as _, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::Args;
use wingbeat::campaign::{Ended, Store, Worker, plan_name};

use super::args::{Place, PointSelection};
use crate::command::output::failure::{FAILED, Failure, INTERRUPTED, in_words};
use crate::command::output::terminal::tell;
use crate::command::signals::stop_flag;

/// Time between two counts on the standard output.
const SAY: Duration = Duration::from_millis(200);

/// Arguments of `wingbeat campaign work`.
#[derive(Args)]
pub(super) struct WorkArgs {
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    part: PointSelection,
    /// The plan that is to be flown, as whoever started us read it.
    #[arg(long)]
    plan: Option<String>,
}

/// The whole command: one thread; points counted on the standard output, an end with the standard input.
pub(super) fn work(args: &WorkArgs) -> Result<(), Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global();
    pool.map_err(|e| Failure::Option(format!("cannot start threads: {e}")))?;
    let stop = stop_flag();
    end_with_input(Arc::clone(&stop));
    let campaign = args.place.campaign()?;
    if args
        .plan
        .as_ref()
        .is_some_and(|p| *p != plan_name(&campaign))
    {
        tell!(
            "error: {} was changed while it was flown, or a file that it names; what is done is kept: the same command flies the file as it is now",
            args.place.file.display()
        );
        return Err(Failure::Told(FAILED));
    }
    let range = args.part.range(campaign.plan().points())?;
    let folder = args.place.folder(&campaign);
    let store = Store::existing(&folder)?;
    let mut worker = Worker::new(&campaign, &store, range)?;
    let mut counter = Counter::default();
    let mut tell = || counter.count();
    // Within the pool: handing it work from outside wakes a thread for every sum.
    let ended = rayon::scope(|_| worker.work(&stop, &mut tell));
    counter.say();
    match ended {
        Ok(Ended::Complete) => Ok(()),
        Ok(Ended::Stopped) => Err(Failure::Told(INTERRUPTED)),
        Ok(Ended::Full(bytes)) => {
            tell!(
                "error: {} has {:.1} MB, more than budget.disk_mb allows; what is done is kept: raise it, or remove files, and run again",
                folder.display(),
                bytes as f64 / 1e6
            );
            Err(Failure::Told(FAILED))
        }
        Err(e) => {
            tell!(
                "{}\nWhat is done is kept; when that is mended, the same command goes on.",
                in_words(&e)
            );
            Err(Failure::Told(FAILED))
        }
    }
}

/// Counts points on the standard output, now and then: whoever reads there needs a processor for it.
#[derive(Default)]
struct Counter {
    points: usize,
    said: Option<Instant>,
}

impl Counter {
    fn count(&mut self) {
        self.points += 1;
        if self.said.is_none_or(|at| at.elapsed() > SAY) {
            self.say();
        }
    }

    fn say(&mut self) {
        let mut out = std::io::stdout().lock();
        let _ = writeln!(out, "{}", self.points).and_then(|()| out.flush()); // nobody may be there to count
        (self.points, self.said) = (0, Some(Instant::now()));
    }
}

/// Stops when the standard input ends, which it does when whoever started us ends.
fn end_with_input(stop: Arc<AtomicBool>) {
    std::thread::spawn(move || {
        let mut rest = [0; 64];
        let mut input = std::io::stdin().lock();
        while input.read(&mut rest).is_ok_and(|n| n > 0) {}
        stop.store(true, Ordering::SeqCst);
    });
}
