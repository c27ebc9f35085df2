//! Many samples in one go beside the same samples one by one: the same bits for few parameters,
//! the same to rounding for more.

use forgetting::rules::{Directional, RandomWalk};
use forgetting::Outcome;
use forgetting::{
    Constant, Dynamic, Equal, Estimator, Exponential, Forgetting, Kernels, NoForgetting, Prior,
    Subspace,
};
use forgetting_kernels::kernel::layout::FEW;

type Plain<F, T> = Estimator<F, Constant<Dynamic<T>>, Equal<Dynamic<T>>, Dynamic<T>>;

/// Sizes around those at which the way of computing changes.
pub fn sizes() -> impl Iterator<Item = usize> {
    (1..=18).chain([24, 31, 32, 33, 40, 41, 64, 100])
}

/// A few regressors are short enough to be left out; some errors are large; the last of several
/// parameters falls silent.
fn record<T: Kernels>(n: usize, samples: usize) -> (Vec<T>, Vec<T>) {
    let mut seed = n as u64 + 7;
    let mut next = move || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut phi = Vec::new();
    for k in 0..samples {
        let scale = if k % 11 == 5 { 1e-5 } else { 1.0 };
        phi.extend((0..n).map(|_| T::from_f64(scale * next())));
        if n > 1 && k > 20 {
            phi[k * n + n - 1] = T::ZERO;
        }
    }
    let y = (0..samples).map(|k| T::from_f64(next() * if k % 7 == 3 { 1e4 } else { 1.0 }));
    (phi, y.collect())
}

fn state<F: Forgetting<Dynamic<T>>, T: Kernels>(estimator: &Plain<F, T>) -> Vec<u64> {
    let factor = estimator.factor();
    [estimator.theta(), factor.packed_columns(), factor.diagonal_elements()]
        .iter()
        .flat_map(|part| part.iter().map(|x| x.to_f64().to_bits()))
        .chain([estimator.samples()])
        .collect()
}

/// Whether two numbers of about this size are the same: bit for bit, or to rounding.
fn same<T: Kernels>(n: usize, a: T, b: T, size: f64) -> bool {
    let margin = if n <= FEW { 0.0 } else { 3e3 * T::EPSILON.to_f64() };
    (a.to_f64() - b.to_f64()).abs() <= margin * size
}

/// Whether two estimators hold the same.
fn assert_same<F: Forgetting<Dynamic<T>>, T: Kernels>(a: &Plain<F, T>, b: &Plain<F, T>) {
    let n = a.theta().len();
    let [mut p, mut q] = [vec![T::ZERO; n * n], vec![T::ZERO; n * n]];
    a.factor().reconstruct(&mut p);
    b.factor().reconstruct(&mut q);
    let deviation = |i: usize| p[i * n + i].to_f64().sqrt();
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let size = deviation(i) * deviation(j);
        assert!(same(n, p[i * n + j], q[i * n + j], size), "n = {n}, P[{i}, {j}]");
    }
    assert_eq!(a.samples(), b.samples());
    if n <= FEW {
        assert_eq!(state(a), state(b), "n = {n}");
    }
}

/// What the monitor says, if there is one.
fn health<F: Forgetting<Dynamic<T>>, T: Kernels>(estimator: &Plain<F, T>) -> Vec<u64> {
    let Some(health) = estimator.health() else { return Vec::new() };
    [health.variance, health.growth, health.noise_variance, health.correlation]
        .iter()
        .chain(health.direction)
        .chain(health.since_excited)
        .map(|x| x.to_f64().to_bits())
        .chain([health.samples, health.since_informed])
        .collect()
}

/// Which of the two ways are watched.
#[derive(Clone, Copy, PartialEq)]
enum Watched {
    Neither,
    Apart,
    Both,
}

/// Goes both ways through a record of which one sample cannot be used; returns the last state,
/// and how often P had wound up.
fn follow<F: Forgetting<Dynamic<T>>, T: Kernels>(rule: F, n: usize, watched: Watched) -> Vec<u64> {
    const SAMPLES: usize = 90;
    let memory = Dynamic::<T>::new(n, 1, 1).unwrap();
    let (rate, prior) = (Constant::new(T::from_f64(0.93)), Prior::scalar(memory, T::from_f64(9.0)));
    let mut together = Estimator::new(rule, rate.unwrap(), Equal::new(), prior.unwrap());
    let mut apart = together.clone();
    if watched != Watched::Neither {
        apart.enable_monitor();
    }
    if watched == Watched::Both {
        together.enable_monitor();
    }
    let (mut phi, y) = record::<T>(n, SAMPLES);
    phi[50 * n] = T::from_f64(f64::NAN);
    let (mut outcomes, mut thetas) = ([Outcome::default(); 17], vec![T::ZERO; 17 * n]);
    let (mut k, mut windups) = (0, 0u64);
    while k < SAMPLES {
        let taken = together.update_many(&phi[k * n..], &y[k..], &mut outcomes, &mut thetas);
        for (outcome, after) in outcomes[..taken].iter().zip(thetas.chunks(n)) {
            let one = apart.update(&phi[k * n..(k + 1) * n], &y[k..=k]).unwrap();
            let many = together.report(outcome);
            assert_eq!(
                (one.forgetting_factor, one.rank, one.skipped),
                (many.forgetting_factor, many.rank, many.skipped),
                "n = {n}, sample {k}"
            );
            // as large as what was subtracted
            let size = 1e4 * (1.0 + one.leverage.to_f64());
            assert!(same(n, one.error[0], many.error[0], size), "n = {n}, sample {k}");
            let size = one.leverage.to_f64();
            assert!(same(n, one.leverage, many.leverage, size), "n = {n}, sample {k}");
            let windup = watched == Watched::Apart || one.windup == many.windup;
            assert!(windup, "n = {n}, sample {k}");
            windups += u64::from(many.windup);
            for (&a, &b) in apart.theta().iter().zip(after) {
                assert!(same(n, a, b, 1e4), "n = {n}, sample {k}: {a:?} {b:?}");
            }
            k += 1;
        }
        if taken == 0 {
            assert_eq!(k, 50, "n = {n}");
            let before = state(&together);
            together.update(&phi[k * n..(k + 1) * n], &y[k..=k]).unwrap_err();
            assert_eq!(before, state(&together));
            phi[50 * n] = T::ONE;
        }
    }
    assert!(together.is_sound());
    assert_same(&together, &apart);
    if watched == Watched::Both && n <= FEW {
        assert_eq!(health(&together), health(&apart), "n = {n}");
    }
    [state(&together), health(&together), vec![windups]].concat()
}

/// Every rule that is done while it measures; returns all states.
pub fn check<T: Kernels>(n: usize) -> Vec<u64> {
    let threshold = T::from_f64(1e-3);
    let mut states = Vec::new();
    for watched in [Watched::Neither, Watched::Apart, Watched::Both] {
        states.extend(follow::<_, T>(NoForgetting::new(), n, watched));
        let exponential = follow::<_, T>(Exponential::new(), n, watched);
        let wound_up = exponential.last() > Some(&0);
        assert!(n != 5 || wound_up || watched != Watched::Both, "nothing wound up");
        states.extend(exponential);
        states.extend(follow::<_, T>(Subspace::new(threshold).unwrap(), n, watched));
        states.extend(follow::<_, T>(Directional::new(threshold).unwrap(), n, watched));
        if n <= FEW {
            let (noise, bound) = (T::from_f64(1e-2), T::from_f64(50.0));
            let walk = RandomWalk::bounded(noise, bound, Dynamic::new(n, 1, 1).unwrap());
            states.extend(follow::<_, T>(walk.unwrap(), n, watched));
        }
    }
    states
}
