//! Leases: who flies which block of points.
//!
//! A lease of block B is the file `B.0`, which only one process can make (`O_EXCL`). It holds who made it and
//! which point is being flown; its time of change is the heartbeat. The lease of a dead process is taken over
//! by making `B.1`, then `B.2`, ..., which again only one process can: whoever has the highest number has the
//! block. A block all of whose points are done has the file `B.done`.
//!
//! A process of the same machine is dead when there is no process with its number and start time; one of
//! another machine when its heartbeat is [`STALE`] old by the clock of the file system. Whoever wakes up after
//! that finds that its lease was taken over and lets it go; what it has flown meanwhile is the same to the bit.

use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use wingbeat_case::IoError;
use wingbeat_results::directory::remove_file;
use wingbeat_results::manifest::sha256;

use crate::store::entries;
use crate::worker::process::{Process, start_of};

/// Heartbeats this old are those of the dead.
pub const STALE: Duration = Duration::from_secs(60);
/// Time between heartbeats.
const BEAT: Duration = Duration::from_secs(5);
/// Digits of the point that is being flown.
const DIGITS: usize = 12;
/// No point is being flown.
const NONE: &str = "------------";

/// What came of the wish to have a block.
#[derive(Debug)]
pub enum Taken {
    /// It is this process's; of a process that died, the point that it was flying.
    Own(Lease, Option<usize>),
    /// Somebody alive has it.
    Held,
    /// All of its points are done.
    Done,
}

/// The leases of a plan.
#[derive(Clone, Debug)]
pub struct Leases {
    folder: PathBuf,
    own: Process,
    /// Where the heart beats.
    beating: Arc<Mutex<Option<Heart>>>,
}

/// A lease, opened once more so that it has a place of its own in the file.
#[derive(Debug)]
struct Heart {
    file: File,
    /// First byte of the lease.
    first: u8,
}

impl Heart {
    /// Writes what is there already: the file system sets the time by its own clock, which is not that of this machine.
    fn beat(&mut self) -> std::io::Result<()> {
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(&[self.first])?;
        self.file.sync_data() // others do not see what a network's file system only notes here
    }
}

/// A block that this process holds.
#[derive(Debug)]
pub struct Lease {
    path: PathBuf,
    next: PathBuf,
    folder: PathBuf,
    block: usize,
    generation: usize,
    file: File,
    /// Where the number of the point stands.
    at: u64,
}

impl Leases {
    /// Of a plan in the directory of its campaign.
    ///
    /// # Errors
    /// A folder that cannot be made.
    pub fn new(folder: PathBuf) -> Result<Self, IoError> {
        fs::create_dir_all(&folder).map_err(IoError::write(&folder))?;
        Ok(Self {
            folder,
            own: Process::own(),
            beating: Arc::default(),
        })
    }

    /// Has a thread beat for the lease of the moment, to the end of the process.
    pub fn beat(&self) {
        let beating = Arc::clone(&self.beating);
        std::thread::spawn(move || {
            loop {
                std::thread::sleep(BEAT);
                let mut heart = beating.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some(heart) = &mut *heart {
                    let _ = heart.beat(); // a late heartbeat is the worst
                }
            }
        });
    }

    fn file(&self, block: usize, generation: usize) -> PathBuf {
        self.folder.join(format!("{block:08}.{generation}"))
    }

    /// Blocks that are done.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub fn done(&self) -> Result<Vec<usize>, IoError> {
        let block = |name: &str| name.strip_suffix(".done")?.parse().ok();
        let of = |file: &PathBuf| file.file_name()?.to_str().and_then(block);
        Ok(entries(&self.folder)?.iter().filter_map(of).collect())
    }

    /// A block that was done is not any more.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn undo(&self, block: usize) -> Result<(), IoError> {
        remove_file(&done_file(&self.folder, block)).map(drop)
    }

    /// Takes a block.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn take(&self, block: usize) -> Result<Taken, IoError> {
        if done_file(&self.folder, block).exists() {
            return Ok(Taken::Done);
        }
        let mut generation = 0;
        let mut flown = None;
        loop {
            let path = self.file(block, generation);
            match OpenOptions::new()
                .read(true)
                .write(true)
                .create_new(true)
                .open(&path)
            {
                // Whoever has the block lets it go, or died as it did: the leases of the dead go first.
                Ok(_) if self.file(block, generation + 1).exists() => {
                    remove_file(&path)?; // whoever has it may be faster
                }
                Ok(file) => return self.begin(path, file, (block, generation), flown),
                Err(e) if e.kind() != ErrorKind::AlreadyExists => {
                    return Err(IoError::write(&path)(e));
                }
                Err(_) => {}
            }
            if !self.file(block, generation + 1).exists() {
                match self.look(&path)? {
                    Holder::Alive => return Ok(Taken::Held),
                    Holder::Dead(point) => flown = point,
                    Holder::Gone => return Ok(Taken::Held), // it was let go; the next pass finds it free
                }
            }
            generation += 1;
        }
    }

    /// Writes the lease that was just made.
    fn begin(
        &self,
        path: PathBuf,
        mut file: File,
        (block, generation): (usize, usize),
        flown: Option<usize>,
    ) -> Result<Taken, IoError> {
        let own = &self.own;
        let head = format!("{} {} {}\n", own.machine, own.number, own.start);
        file.write_all(format!("{head}{NONE}\n").as_bytes())
            .map_err(|e| {
                let _ = fs::remove_file(&path); // nobody may take it for a lease
                IoError::write(&path)(e)
            })?;
        let again = OpenOptions::new().write(true).open(&path);
        let heart = Heart {
            file: again.map_err(IoError::write(&path))?,
            first: head.as_bytes()[0],
        };
        let lease = Lease {
            next: self.file(block, generation + 1),
            folder: self.folder.clone(),
            path,
            block,
            generation,
            at: head.len() as u64,
            file,
        };
        if done_file(&self.folder, block).exists() {
            lease.let_go(); // it was done meanwhile
            return Ok(Taken::Done);
        }
        *self.beating.lock().unwrap_or_else(PoisonError::into_inner) = Some(heart);
        Ok(Taken::Own(lease, flown))
    }

    /// Who has a lease.
    fn look(&self, path: &Path) -> Result<Holder, IoError> {
        let mut text = String::new();
        let read = File::open(path).and_then(|mut f| {
            f.read_to_string(&mut text)?;
            f.metadata()?.modified()
        });
        let changed = match read {
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Holder::Gone),
            read => read.map_err(IoError::read(path))?,
        };
        let point = text.lines().nth(1).and_then(|n| n.parse().ok());
        let holder = Process::decoded(&text);
        let here = holder
            .as_ref()
            .is_some_and(|h| h.machine == self.own.machine && !h.start.is_empty());
        let is_dead = match holder {
            Some(h) if here => start_of(h.number).as_deref() != Some(&h.start),
            // On another machine, or not written yet: its heartbeat says.
            _ => self.age(changed)? > STALE,
        };
        Ok(if is_dead {
            Holder::Dead(point)
        } else {
            Holder::Alive
        })
    }

    /// How long ago that was by the clock of the file system.
    fn age(&self, changed: SystemTime) -> Result<Duration, IoError> {
        let path = self.clock();
        let read = || {
            let mut file = File::create(&path)?;
            file.write_all(b"?")?;
            file.sync_data()?; // as a heartbeat
            file.metadata()?.modified() // of the open file: its name may be gone
        };
        let now = read();
        let _ = fs::remove_file(&path); // only its time was asked for
        let now = now.map_err(IoError::write(&path))?;
        Ok(now.duration_since(changed).unwrap_or_default())
    }

    /// The file whose time is that of the file system; processes of two machines or containers may have the
    /// same number.
    fn clock(&self) -> PathBuf {
        let machine = &sha256(self.own.machine.as_bytes())[..8];
        let name = format!("clock.{machine}.{}", self.own.number);
        self.folder.join(name)
    }

    /// Blocks that somebody alive flies now.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub fn held(&self) -> Result<usize, IoError> {
        let lease = |name: &str| {
            name.rsplit_once('.')
                .is_some_and(|(b, g)| b.parse::<usize>().is_ok() && g.parse::<usize>().is_ok())
        };
        let is_lease =
            |file: &PathBuf| file.file_name().and_then(|n| n.to_str()).is_some_and(lease);
        // Where no clock can be written, the heartbeats of other machines say nothing.
        let is_held =
            |file: &PathBuf| is_lease(file) && matches!(self.look(file), Ok(Holder::Alive));
        Ok(entries(&self.folder)?.iter().filter(|f| is_held(f)).count())
    }
}

fn done_file(folder: &Path, block: usize) -> PathBuf {
    folder.join(format!("{block:08}.done"))
}

enum Holder {
    Alive,
    Dead(Option<usize>),
    Gone,
}

impl Lease {
    /// Says which point is being flown; whether the block is still held.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn fly(&mut self, point: usize) -> Result<bool, IoError> {
        let number = format!("{point:0DIGITS$}");
        self.write(&number)?;
        Ok(!self.next.exists())
    }

    /// Says that no point is being flown.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn rest(&mut self) -> Result<(), IoError> {
        self.write(NONE)
    }

    fn write(&mut self, text: &str) -> Result<(), IoError> {
        let put = self.file.seek(SeekFrom::Start(self.at));
        let put = put.and_then(|_| self.file.write_all(text.as_bytes()));
        put.map_err(IoError::write(&self.path))
    }

    /// All points of the block are done.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn done(self) -> Result<(), IoError> {
        let path = done_file(&self.folder, self.block);
        fs::write(&path, "").map_err(IoError::write(&path))?;
        self.let_go();
        Ok(())
    }

    /// Leaves the block to who has taken it over: takes away one's own lease alone, which nobody would find dead.
    pub fn withdraw(self) {
        let _ = fs::remove_file(&self.path); // at worst found dead later
    }

    /// Leaves the block to others: the leases of the dead first, one's own last.
    pub fn let_go(self) {
        let stem = format!("{:08}", self.block);
        for generation in 0..=self.generation {
            let _ = fs::remove_file(self.folder.join(format!("{stem}.{generation}"))); // at worst found dead later
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn leases(name: &str) -> Leases {
        let folder = format!("wingbeat-lease-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(folder);
        let _ = fs::remove_dir_all(&folder);
        Leases::new(folder).unwrap()
    }

    /// A process that has ended: its lease is taken over once, with the point it was flying.
    #[test]
    fn exact_the_lease_of_a_dead_process_is_taken_over_once() {
        let leases = leases("dead");
        let mut child = std::process::Command::new("sleep")
            .arg("100")
            .spawn()
            .unwrap();
        let process = Process {
            number: child.id(),
            start: start_of(child.id()).unwrap(),
            ..Process::own()
        };
        let text = format!(
            "{} {} {}\n000000000007\n",
            process.machine, process.number, process.start
        );
        fs::write(leases.file(3, 0), &text).unwrap();
        assert!(
            matches!(leases.take(3).unwrap(), Taken::Held),
            "it is alive"
        );
        child.kill().unwrap();
        // Dead, though nobody has waited for it.
        let begun = std::time::Instant::now();
        let (mut lease, flown) = loop {
            match leases.take(3).unwrap() {
                Taken::Own(lease, flown) => break (lease, flown),
                other => assert!(begun.elapsed() < Duration::from_secs(10), "{other:?}"),
            }
        };
        assert_eq!((flown, lease.generation), (Some(7), 1));
        child.wait().unwrap();
        assert!(matches!(leases.take(3).unwrap(), Taken::Held), "it is held");
        assert!(lease.fly(0).unwrap());
        // Somebody takes us for dead.
        fs::write(leases.file(3, 2), &text).unwrap();
        assert!(!lease.fly(1).unwrap(), "not held any more");
        lease.withdraw();
        assert!(!leases.file(3, 1).exists() && leases.file(3, 2).exists());
        let Taken::Own(lease, flown) = leases.take(3).unwrap() else {
            panic!("the third is dead")
        };
        assert_eq!((flown, lease.generation), (Some(7), 3));
        lease.done().unwrap();
        assert!(matches!(leases.take(3).unwrap(), Taken::Done));
        assert_eq!(leases.done().unwrap(), [3]);
        leases.undo(3).unwrap();
        assert!(matches!(leases.take(3).unwrap(), Taken::Own(_, None)));
        fs::remove_dir_all(&leases.folder).unwrap();
    }

    /// Leases are let go one after the other: who asks for the block in between neither has it nor keeps the
    /// others from it.
    #[test]
    fn behaves_a_block_that_is_being_let_go_is_not_lost() {
        let leases = leases("between");
        let mut dead = Process::own();
        dead.start += "0"; // of this number there was another
        let text = |p: &Process| format!("{} {} {}\n{NONE}\n", p.machine, p.number, p.start);
        fs::write(leases.file(5, 1), text(&leases.own)).unwrap();
        assert!(matches!(leases.take(5).unwrap(), Taken::Held));
        assert!(!leases.file(5, 0).exists(), "nobody holds the first");
        // Whoever let it go died in between.
        fs::write(leases.file(5, 1), text(&dead)).unwrap();
        let Taken::Own(mut lease, None) = leases.take(5).unwrap() else {
            panic!("it is free")
        };
        assert!(lease.fly(0).unwrap() && lease.generation == 2);
        lease.done().unwrap();
        assert!(matches!(leases.take(5).unwrap(), Taken::Done));
        fs::remove_dir_all(&leases.folder).unwrap();
    }

    /// The file system sets the time of a heartbeat: an old lease is as young as a file written just then. The
    /// lease stays what it is while its points are written between heartbeats.
    #[test]
    fn behaves_a_heartbeat_has_the_time_of_the_file_system() {
        let leases = leases("heart");
        let Taken::Own(mut lease, None) = leases.take(4).unwrap() else {
            panic!("it is free")
        };
        let path = leases.file(4, 0);
        let text = |point: &str| {
            let own = &leases.own;
            format!("{} {} {}\n{point}\n", own.machine, own.number, own.start)
        };
        for point in [7, 8] {
            assert!(lease.fly(point).unwrap());
            let old = SystemTime::now() - 2 * STALE;
            lease.file.set_modified(old).unwrap();
            let mut heart = leases.beating.lock().unwrap();
            heart.as_mut().unwrap().beat().unwrap();
            let changed = fs::metadata(&path).unwrap().modified().unwrap();
            assert!(leases.age(changed).unwrap() < STALE / 2);
            let wanted = text(&format!("{point:0DIGITS$}"));
            assert_eq!(fs::read_to_string(&path).unwrap(), wanted);
        }
        fs::remove_dir_all(&leases.folder).unwrap();
    }

    /// Two containers in which processes have the same number ask for the time of one file system at once.
    #[test]
    fn behaves_processes_of_the_same_number_do_not_share_a_clock() {
        let one = leases("clock");
        let mut other = one.clone();
        other.own.machine += "/another";
        assert_ne!(one.clock(), other.clock());
        let ask = |leases: &Leases| {
            for _ in 0..300 {
                leases.age(SystemTime::now()).unwrap();
            }
        };
        std::thread::scope(|threads| {
            for leases in [&one, &one, &other] {
                threads.spawn(move || ask(leases));
            }
        });
        fs::remove_dir_all(&one.folder).unwrap();
    }

    /// Another machine: only the age of the heartbeat tells.
    #[test]
    fn exact_a_lease_of_another_machine_lapses_with_its_heartbeat() {
        let leases = leases("far");
        fs::write(leases.file(0, 0), "elsewhere/1/2 17 99\n000000000000\n").unwrap();
        assert!(matches!(leases.take(0).unwrap(), Taken::Held));
        let file = File::options().write(true).open(leases.file(0, 0)).unwrap();
        let old = SystemTime::now() - STALE - Duration::from_secs(2);
        file.set_modified(old).unwrap();
        assert!(matches!(leases.take(0).unwrap(), Taken::Own(_, Some(0))));
        fs::remove_dir_all(&leases.folder).unwrap();
    }
}
