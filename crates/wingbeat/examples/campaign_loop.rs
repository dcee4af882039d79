//! What campaigns are measured against: a plain loop over every n-th point from k on, each flown in memory and
//! forgotten, in one thread. `campaign_loop FILE k n`

use std::path::Path;

use wingbeat::Flight;
use wingbeat::campaign::Campaign;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let (Some(file), Some(k), Some(n)) = (words.next(), words.next(), words.next()) else {
        return Err("campaign_loop FILE k n".into());
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()?;
    let campaign = Campaign::read(Path::new(&file))?;
    let mut lift = 0.0;
    rayon::scope(|_| -> Result<(), wingbeat::Error> {
        for i in (k.parse().unwrap_or(0)..campaign.plan().points()).step_by(n.parse().unwrap_or(1))
        {
            let overrides = campaign.overrides(i);
            let keys: Vec<&str> = overrides.iter().map(String::as_str).collect();
            let run = Flight::preset_with(&campaign.raw().case, &keys)?.fly()?;
            lift += run.beats().last().map_or(0.0, |b| b.lift_over_weight);
        }
        Ok(())
    })?;
    println!("sum of lift over weight: {lift}");
    Ok(())
}
