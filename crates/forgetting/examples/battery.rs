//! The resistance of a battery cell that ages, followed by two rules while the current rests: one winds up,
//! the other does not.

use forgetting::choice::Defaults;
use forgetting::rates::AnyRate;
use forgetting::rules::Rule;
use forgetting::weightings::AnyWeighting;
use forgetting::{Constant, Equal, Error, Named, Prior, UpTo};

type Memory = UpTo<f64, 2>;

fn estimator(rule: &str) -> Result<Named<Memory>, Error> {
    let memory = Memory::new(2)?;
    let rule = Rule::named(rule, &Defaults, memory)?;
    let rate = AnyRate::Constant(Constant::new(0.99)?);
    let weighting = AnyWeighting::Equal(Equal::new());
    Ok(Named::new(rule, rate, weighting, Prior::scalar(memory, 100.0)?))
}

fn main() -> Result<(), Error> {
    println!("{:>12} {:>8} {:>10} {:>12} {:>7}", "rule", "sample", "mOhm", "variance", "windup");
    for rule in ["exponential", "subspace"] {
        let mut cell = estimator(rule)?;
        for k in 0..4000_u32 {
            let rests = (1000..3000).contains(&k);
            let current = if rests { 0.0 } else { 2.0 + f64::from(k % 11) / 10.0 };
            let resistance = if k < 1000 { 0.05 } else { 0.075 };
            let voltage =
                3.7 - resistance * current + 1e-3 * (f64::from(k * 7919 % 101) / 50.0 - 1.0);
            let windup = cell.update(&[1.0, -current], &[voltage])?.windup;
            if k % 1000 == 999 {
                let mut p = [0.0; 4];
                cell.factor().reconstruct(&mut p);
                let resistance = 1e3 * cell.theta()[1];
                println!("{rule:>12} {:>8} {resistance:>10.2} {:>12.3e} {windup:>7}", k + 1, p[3]);
            }
        }
    }
    Ok(())
}
