//! Compact estimators, and estimators in memory of a fixed size, against those on the heap: the same bits
//! after every sample, and the same bytes when saved.

use forgetting::choice::Defaults;
use forgetting::compact::Walk;
use forgetting::gates::{AnyGate, Open};
use forgetting::rates::AnyRate;
use forgetting::rules::{Directional, Exponential, NoForgetting, Rule, Subspace};
use forgetting::weightings::AnyWeighting;
use forgetting::{
    AnyEstimator, Compact, Constant, Dynamic, Equal, Error, Estimator, Fixed, Forgetting, Kernels,
    Memory, Named, Noise, Packed, Prior, Real, Size, UpTo,
};

const VARIANCE: f64 = 50.0;
const LAMBDA: f64 = 0.97;

/// Numbers in [−1, 1), none at times.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f64 / f64::from(1 << 23) - 1.0
    }

    fn sample<T: Kernels, const N: usize>(&mut self, k: usize) -> ([T; N], T) {
        let mut phi = [T::ZERO; N];
        for (i, x) in phi.iter_mut().enumerate() {
            let number = self.next();
            let silent = k % 50 > 30 && (i > 0 || k % 50 > 45);
            *x = T::from_f64(if silent { 0.0 } else { number });
        }
        (phi, T::from_f64(self.next() + f64::from(k as u32 % 90) / 30.0))
    }

    /// How long after the last one a sample comes, and Γ if it is known; most come as they come.
    fn circumstances<T: Kernels>(&mut self, k: usize) -> (T, Option<T>) {
        let times = [0.0, 0.5, 1.0, 2.0, 40.0, 1e-30, 1e4];
        let elapsed = if k % 3 == 1 { times[k % times.len()] } else { 1.0 };
        let gamma = (k % 4 == 2).then(|| T::from_f64(10f64.powf(4.0 * self.next())));
        (T::from_f64(elapsed), gamma)
    }
}

fn noise<T>(gamma: Option<T>) -> Noise<'static, T> {
    gamma.map_or(Noise::Unit, Noise::Scalar)
}

fn estimator<M: Memory>(rule: &str, memory: M) -> Named<M> {
    let prior = Prior::scalar(memory, M::Real::from_f64(VARIANCE)).unwrap();
    let lambda = Constant::new(M::Real::from_f64(if rule == "random_walk" { 1.0 } else { LAMBDA }));
    let lambda = lambda.unwrap();
    let rule = Rule::named(rule, &Defaults, memory).unwrap();
    let weighting = AnyWeighting::Equal(Equal::new());
    Estimator::new(rule, AnyRate::Constant(lambda), weighting, prior)
        .with_gate(AnyGate::Open(Open::new()))
}

fn bytes(save: impl FnOnce(&mut dyn FnMut(&[u8])) -> Result<usize, Error>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let count = save(&mut |piece| bytes.extend_from_slice(piece)).unwrap();
    assert_eq!(count, bytes.len());
    bytes
}

fn same<F, T, const N: usize>(rule: &str)
where
    F: Forgetting<Fixed<T, N>>,
    T: Kernels,
    Size<N>: Packed<T>,
{
    let lambda = if rule == "random_walk" { 1.0 } else { LAMBDA };
    let (variance, lambda) = (T::from_f64(VARIANCE), T::from_f64(lambda));
    let mut compact = Compact::<F, T, N>::new(&Defaults, lambda, variance, &[T::ZERO; N]).unwrap();
    let mut whole: AnyEstimator<T> = estimator(rule, Dynamic::new(N, 1, 1).unwrap());
    let mut part = estimator(rule, UpTo::<T, 32, 8>::new(N).unwrap());
    let mut numbers = Numbers(N as u64);
    let start = bytes(|put| compact.save(rule, put));
    for k in 0..300 {
        let (phi, y) = numbers.sample::<T, N>(k);
        let (elapsed, gamma) = numbers.circumstances::<T>(k);
        let outcome = if elapsed == T::ONE && gamma.is_none() {
            compact.update(&phi, y)
        } else {
            compact.update_after(elapsed, &phi, y, gamma)
        };
        let update = whole.update_after(elapsed, &phi, &[y], noise(gamma));
        let (outcome, update) = (outcome.unwrap(), update.unwrap());
        assert_eq!(outcome.error, update.error[0], "{rule} {N} {k}");
        assert_eq!(outcome.leverage, update.leverage, "{rule} {N} {k}");
        assert_eq!(outcome.used, update.skipped.is_none(), "{rule} {N} {k}");
        assert_eq!(outcome.windup, update.windup, "{rule} {N} {k}");
        part.update_after(elapsed, &phi, &[y], noise(gamma)).unwrap();
        if k % 60 == 0 {
            let saved = whole.to_bytes().unwrap();
            assert_eq!(bytes(|put| compact.save(rule, put)), saved, "{rule} {N} {k}");
            assert_eq!(bytes(|put| part.save(put)), saved, "{rule} {N} {k}");
            compact = Compact::from_bytes(rule, &saved).unwrap();
            part = Named::from_bytes(&saved).unwrap();
        }
    }
    let mut dense = [[T::ZERO; N]; N];
    compact.covariance(&mut dense);
    let mut expected = vec![T::ZERO; N * N];
    whole.factor().reconstruct(&mut expected);
    for (x, y) in dense.as_flattened().iter().zip(&expected) {
        let scale = y.abs().to_f64().max(1e-3);
        assert!((x.to_f64() - y.to_f64()).abs() < 1e-4 * scale, "{rule} {N}: {x:?} {y:?}");
    }
    compact.reset();
    assert_eq!(bytes(|put| compact.save(rule, put)), start);
}

macro_rules! every_size {
    ($Rule:ident, $rule:literal) => {
        every_size!($Rule, $rule, f32, 1 2 3 4 5 6 7 8 9 10);
        every_size!($Rule, $rule, f64, 1 2 3 4 5 6 7 8 9 10);
    };
    ($Rule:ident, $rule:literal, $T:ty, $($n:literal)*) => {
        $(same::<$Rule<Fixed<$T, $n>>, $T, $n>($rule);)*
    };
}

#[test]
fn the_bits_are_those_of_an_estimator_on_the_heap() {
    every_size!(NoForgetting, "none");
    every_size!(Exponential, "exponential");
    every_size!(Subspace, "subspace");
    every_size!(Directional, "directional");
    every_size!(Walk, "random_walk");
}

type Two<T> = Compact<Exponential<Fixed<T, 2>>, T, 2>;

fn two(lambda: f32) -> Two<f32> {
    Compact::new(&Defaults, lambda, 100.0, &[0.0; 2]).unwrap()
}

#[test]
fn what_is_refused_changes_nothing() {
    let mut compact = two(0.5);
    compact.update(&[1.0, 2.0], 3.0).unwrap();
    let before = bytes(|put| compact.save("exponential", put));
    for (phi, y) in [
        ([f32::NAN, 1.0], 1.0),
        ([1.0, f32::INFINITY], 1.0),
        ([1.0, 1.0], f32::NAN),
        ([1.0, 1.0], 1e30),
        ([1e15, 1.0], 1.0),
    ] {
        assert!(compact.update(&phi, y).is_err(), "{phi:?} {y}");
        assert_eq!(bytes(|put| compact.save("exponential", put)), before);
    }
}

#[test]
fn circumstances_out_of_range_are_refused_and_change_nothing() {
    let mut compact = two(0.5);
    compact.update(&[1.0, 2.0], 3.0).unwrap();
    let before = bytes(|put| compact.save("exponential", put));
    for (elapsed, gamma, parameter) in [
        (-1.0, None, "elapsed"),
        (f32::NAN, None, "elapsed"),
        (f32::INFINITY, None, "elapsed"),
        (1.0, Some(0.0), "gamma"),
        (1.0, Some(-1.0), "gamma"),
        (1.0, Some(f32::NAN), "gamma"),
        (1.0, Some(f32::INFINITY), "gamma"),
    ] {
        let refused = compact.update_after(elapsed, &[1.0, 1.0], 1.0, gamma);
        assert!(
            matches!(refused, Err(Error::Value { parameter: named, .. }) if named == parameter),
            "{elapsed} {gamma:?}"
        );
        assert_eq!(bytes(|put| compact.save("exponential", put)), before);
    }
    for (phi, y, gamma) in
        [([f32::NAN, 1.0], 1.0, 4.0), ([1.0, 1.0], 1e30, 4.0), ([1e3, 1.0], 1.0, 1e-35)]
    {
        assert!(compact.update_after(1.0, &phi, y, Some(gamma)).is_err(), "{phi:?} {y} {gamma}");
        assert_eq!(bytes(|put| compact.save("exponential", put)), before);
    }
}

#[test]
fn theta_can_be_put() {
    let (mut compact, memory) = (two(0.9), Dynamic::<f32>::new(2, 1, 1).unwrap());
    let mut whole = estimator("exponential", memory);
    let mut numbers = Numbers(1);
    let mut compact_of_whole = |whole: &AnyEstimator<f32>| {
        compact = Two::from_bytes("exponential", &whole.to_bytes().unwrap()).unwrap();
        compact.clone()
    };
    for k in 0..20 {
        let (phi, y) = numbers.sample::<f32, 2>(k);
        whole.update(&phi, &[y]).unwrap();
        let mut moved = compact_of_whole(&whole);
        whole.set_theta(&[0.5, y]).unwrap();
        moved.set_theta(&[0.5, y]).unwrap();
        assert_eq!(bytes(|put| moved.save("exponential", put)), whole.to_bytes().unwrap());
        for wrong in [[f32::NAN, 0.0], [0.0, f32::INFINITY], [1e30, 0.0]] {
            assert!(matches!(
                moved.set_theta(&wrong),
                Err(Error::Value { parameter: "theta", .. })
            ));
            assert_eq!(moved.theta(), &[0.5, y]);
        }
    }
}

#[test]
fn windup_is_reported_and_ends_before_the_range_of_the_numbers() {
    let bits = |theta: &[f32]| theta.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let mut compact = two(0.5);
    let mut whole: AnyEstimator<f32> = {
        let memory = Dynamic::new(2, 1, 1).unwrap();
        let prior = Prior::scalar(memory, 100.0).unwrap();
        let rule = Rule::named("exponential", &Defaults, memory).unwrap();
        let rate = AnyRate::Constant(Constant::new(0.5).unwrap());
        Estimator::new(rule, rate, AnyWeighting::Equal(Equal::new()), prior)
    };
    // room for P ends after some fifty samples
    for k in 0..200 {
        let expected = whole.update(&[1.0, 0.0], &[1.0]).unwrap();
        let outcome = compact.update(&[1.0, 0.0], 1.0).unwrap();
        assert_eq!((outcome.windup, outcome.forgot), (expected.windup, expected.rank > 0), "{k}");
        assert_eq!(outcome.windup, k >= 3, "{k}");
        assert_eq!(outcome.forgot, k < 55, "{k}");
        assert_eq!(bits(compact.theta()), bits(whole.theta()), "{k}");
    }
    for _ in 0..3 {
        whole.update(&[1.0, 2.0], &[5.0]).unwrap();
        compact.update(&[1.0, 2.0], 5.0).unwrap();
    }
    assert_eq!(bits(compact.theta()), bits(whole.theta()));
    assert!((compact.theta()[1] - 2.0).abs() < 1e-3);
}

#[test]
fn settings_out_of_range_are_refused() {
    let theta = [0.0; 2];
    for (lambda, variance, theta) in [
        (0.0, 1.0, theta),
        (1.5, 1.0, theta),
        (f32::NAN, 1.0, theta),
        (0.9, 0.0, theta),
        (0.9, f32::NAN, theta),
        (0.9, 1e30, theta),
        (0.9, 1.0, [1.0, f32::NAN]),
    ] {
        let refused = Two::new(&Defaults, lambda, variance, &theta);
        assert!(matches!(refused, Err(Error::Value { .. })), "{lambda} {variance} {theta:?}");
    }
}

#[test]
fn bytes_of_another_estimator_are_refused() {
    let saved = bytes(|put| two(0.9).save("exponential", put));
    assert!(Two::<f32>::from_bytes("exponential", &saved).is_ok());
    assert!(Two::<f32>::from_bytes("subspace", &saved).is_err());
    assert!(Two::<f64>::from_bytes("exponential", &saved).is_err());
    let three = Compact::<Exponential<Fixed<f32, 3>>, f32, 3>::from_bytes("exponential", &saved);
    assert!(three.is_err());
    for i in 0..saved.len() {
        let mut altered = saved.clone();
        altered[i] ^= 1;
        assert!(Two::<f32>::from_bytes("exponential", &altered).is_err(), "{i}");
        assert!(Two::<f32>::from_bytes("exponential", &saved[..i]).is_err(), "{i}");
    }
    let mut monitored = estimator("exponential", Dynamic::<f32>::new(2, 1, 1).unwrap());
    monitored.enable_monitor();
    assert!(Two::<f32>::from_bytes("exponential", &monitored.to_bytes().unwrap()).is_err());
}
