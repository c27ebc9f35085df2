//! The compact bank against the default bank on the heap: the same bits after every sample, and the same
//! bytes when saved.

use forgetting::bank::{default_members, default_mixer, Bank};
use forgetting::choice::Defaults;
use forgetting::compact;
use forgetting::mixers::AnyMixer;
use forgetting::rates::AnyRate;
use forgetting::rules::{RandomWalk, Rule};
use forgetting::weightings::AnyWeighting;
use forgetting::{
    AnyEstimator, Constant, Dynamic, Equal, Error, Estimator, Kernels, Noise, Packed, Prior, Size,
};

/// Numbers in [−1, 1).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f64 / f64::from(1 << 23) - 1.0
    }

    /// Regressors in units far apart, none at times, the last one silent at first; y with gross errors.
    fn sample<T: Kernels, const N: usize>(&mut self, k: usize) -> ([T; N], T) {
        let mut phi = [T::ZERO; N];
        for (i, x) in phi.iter_mut().enumerate() {
            let silent = (k % 50 > 40 && i != 1) || (k < 25 && i > 0 && i + 1 == N);
            let number = 10f64.powi(3 * (i as i32 % 3 - 1)) * self.next();
            *x = T::from_f64(if silent { 0.0 } else { number });
        }
        let drift = f64::from(k as u32 % 90) / 30.0;
        (phi, T::from_f64(self.next() * if k % 37 == 5 { 100.0 } else { 1.0 } + drift))
    }

    /// How long after the last one a sample comes, and Γ if it is known; most come as they come.
    fn circumstances<T: Kernels>(&mut self, k: usize) -> (T, Option<T>) {
        let times = [0.0, 0.5, 1.0, 2.0, 40.0, 1e4];
        let elapsed = if k % 5 == 1 { times[k % times.len()] } else { 1.0 };
        let gamma = (k % 7 == 2).then(|| T::from_f64(10f64.powf(2.0 * self.next())));
        (T::from_f64(elapsed), gamma)
    }
}

fn mixer<T: Kernels>(name: &str, count: usize) -> AnyMixer<Dynamic<T>> {
    AnyMixer::named(name, &Defaults, Dynamic::new(count, 1, 1).unwrap()).unwrap()
}

fn default<T: Kernels>(n: usize) -> Bank<T> {
    let members = default_members(Dynamic::new(n, 1, 1).unwrap()).unwrap();
    Bank::of_data(members, default_mixer().unwrap()).unwrap()
}

fn bytes<T: Kernels, const N: usize>(bank: &mut compact::Bank<T, N>) -> Vec<u8>
where
    Size<N>: Packed<T>,
{
    let mut bytes = Vec::new();
    let count = bank.save(&mut |piece| bytes.extend_from_slice(piece)).unwrap();
    assert_eq!(count, bytes.len());
    bytes
}

fn near<T: Kernels>(own: &[T], expected: &[T], what: &str) {
    let largest = expected.iter().fold(0f64, |largest, x| largest.max(x.to_f64().abs()));
    for (x, y) in own.iter().zip(expected) {
        let scale = y.to_f64().abs().max(1e-6 * largest);
        assert!((x.to_f64() - y.to_f64()).abs() < 1e-3 * scale, "{what}: {own:?} {expected:?}");
    }
}

/// Both take 400 samples; the compact one is saved and read again on its way.
fn same<T: Kernels, const N: usize>(mut own: compact::Bank<T, N>, mut whole: Bank<T>)
where
    Size<N>: Packed<T>,
{
    let mut numbers = Numbers(N as u64);
    let start = bytes(&mut own);
    assert_eq!(start, whole.to_bytes().unwrap());
    for k in 0..400 {
        let (phi, y) = numbers.sample::<T, N>(k);
        let (elapsed, gamma) = numbers.circumstances::<T>(k);
        let outcome = if elapsed == T::ONE && gamma.is_none() {
            own.update(&phi, y)
        } else {
            own.update_after(elapsed, &phi, y, gamma)
        };
        let noise = gamma.map_or(Noise::Unit, Noise::Scalar);
        let expected = whole.update_after(elapsed, &phi, &[y], noise);
        let (outcome, expected) = (outcome.unwrap(), expected.unwrap());
        assert_eq!(format!("{outcome:?}"), format!("{expected:?}"), "{N} {k}");
        assert_eq!(own.theta(), whole.theta(), "{N} {k}");
        assert_eq!(own.weights(), whole.weights(), "{N} {k}");
        if k % 60 == 0 {
            let saved = whole.to_bytes().unwrap();
            assert_eq!(bytes(&mut own), saved, "{N} {k}");
            own = compact::Bank::from_bytes(&saved).unwrap();
            whole = Bank::from_bytes(&saved).unwrap();
        }
    }
    let (mut p, mut expected) = (vec![T::ZERO; N * N], vec![T::ZERO; N * N]);
    own.covariance(&mut p);
    whole.covariance(&mut expected);
    near(&p, &expected, "covariance");
    assert_eq!((own.samples(), own.noise_variance()), (whole.samples(), whole.noise_variance()));
    let (phi, _) = numbers.sample::<T, N>(0);
    let (mut y, mut expected) = ([T::ZERO], [T::ZERO]);
    own.predict(&phi, &mut y).unwrap();
    whole.predict(&phi, &mut expected).unwrap();
    assert_eq!(y, expected);
    own.reset();
    assert_eq!(bytes(&mut own), start);
}

macro_rules! every_size {
    ($T:ty: $($n:literal)*) => {
        $(same(compact::Bank::<$T, $n>::of_walks(None, &[0.0; $n]).unwrap(), default($n));)*
    };
}

#[test]
fn the_bits_are_those_of_the_default_bank() {
    every_size!(f32: 1 2 3 4 5 6 7 8);
    every_size!(f64: 1 2 3 4 5 6 7 8);
}

/// The default walks with a prior that is given: they take the regressors as they are.
fn walks<T: Kernels>(variance: T, theta: &[T]) -> Vec<AnyEstimator<T>> {
    let memory = Dynamic::new(theta.len(), 1, 1).unwrap();
    let walking = |&noise: &f64| {
        let rule = RandomWalk::bounded(T::from_f64(noise), T::from_f64(1e5), memory).unwrap();
        let rate = AnyRate::Constant(Constant::new(T::ONE).unwrap());
        let prior = Prior::scalar(memory, variance).unwrap().with_theta(theta).unwrap();
        Estimator::new(Rule::RandomWalk(rule), rate, AnyWeighting::Equal(Equal::new()), prior)
    };
    forgetting::bank::DEFAULT_NOISE.iter().map(walking).collect()
}

#[test]
fn a_prior_can_be_given() {
    let theta = [1.0, -2.0, 0.5];
    let own = compact::Bank::<f64, 3>::of_walks(Some(50.0), &theta).unwrap();
    same(own, Bank::new(walks(50.0, &theta), default_mixer().unwrap()).unwrap());
    for (variance, theta, named) in [
        (Some(-1.0), [0.0; 2], "initial_covariance"),
        (Some(f64::NAN), [0.0; 2], "initial_covariance"),
        (Some(1.0), [0.0, f64::NAN], "initial_theta"),
    ] {
        let refused = compact::Bank::<f64, 2>::of_walks(variance, &theta);
        assert!(matches!(refused, Err(Error::Value { parameter, .. }) if parameter == named));
    }
    let refused = compact::Bank::<f64, 2>::of_walks(None, &[0.0, 1.0]);
    assert!(matches!(refused, Err(Error::Unsupported { .. })));
}

#[test]
fn what_is_refused_changes_nothing() {
    let mut own = compact::Bank::<f32, 2>::of_walks(None, &[0.0; 2]).unwrap();
    let mut whole = default::<f32>(2);
    own.update(&[1.0, 0.0], 3.0).unwrap();
    whole.update(&[1.0, 0.0], &[3.0], Noise::Unit).unwrap();
    let before = bytes(&mut own);
    for (phi, y, elapsed, gamma) in [
        ([f32::NAN, 1.0], 1.0, 1.0, None),
        ([1.0, f32::INFINITY], 1.0, 1.0, None),
        ([1.0, 1.0], f32::NAN, 1.0, None),
        ([1.0, 1.0], 1e30, 1.0, None),
        ([1.0, 1.0], 1.0, -1.0, None),
        ([1.0, 1.0], 1.0, f32::NAN, None),
        ([1.0, 1.0], 1.0, 2.0, Some(0.0)),
        ([1.0, 1.0], 1.0, 1.0, Some(f32::NAN)),
    ] {
        let noise = gamma.map_or(Noise::Unit, Noise::Scalar);
        let expected = whole.update_after(elapsed, &phi, &[y], noise).unwrap_err();
        let refused = own.update_after(elapsed, &phi, y, gamma).unwrap_err();
        // as text: a value may be no number
        assert_eq!(format!("{refused:?}"), format!("{expected:?}"));
        assert_eq!(bytes(&mut own), before, "{phi:?} {y}");
    }
}

/// A member that cannot take a sample sleeps in both.
#[test]
fn the_same_members_sleep() {
    let mut own = compact::Bank::<f32, 2>::of_walks(Some(1e-3), &[0.0; 2]).unwrap();
    let mut whole = Bank::new(walks(1e-3, &[0.0; 2]), default_mixer().unwrap()).unwrap();
    let (mut numbers, mut asleep) = (Numbers(5), 0);
    // the fast walks then predict what is beyond the range
    let first = [([1.0, 0.0], 1e15), ([1e5, 0.0], 0.0)];
    for k in 0..100 {
        let next = ([numbers.next() as f32, numbers.next() as f32], numbers.next() as f32);
        let (phi, y) = first.get(k).copied().unwrap_or(next);
        let update = own.update(&phi, y).unwrap();
        let expected = whole.update(&phi, &[y], Noise::Unit).unwrap();
        asleep += expected.asleep;
        assert_eq!(format!("{update:?}"), format!("{expected:?}"), "{k}");
    }
    assert_eq!(bytes(&mut own), whole.to_bytes().unwrap());
    assert!(asleep > 0);
}

fn refused<const N: usize>(saved: &[u8]) -> &'static str
where
    Size<N>: Packed<f64>,
{
    match compact::Bank::<f64, N>::from_bytes(saved) {
        Err(Error::State { reason }) => reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn other_bytes_are_refused() {
    let saved = default::<f64>(2).to_bytes().unwrap();
    assert!(compact::Bank::<f64, 2>::from_bytes(&saved).is_ok());
    assert!(refused::<3>(&saved).contains("other sizes"));
    assert!(refused::<2>(&default::<f32>(2).to_bytes().unwrap()).contains("another type"));
    let members = default_members::<f64>(Dynamic::new(2, 1, 1).unwrap()).unwrap();
    let of = |count: usize, name: &str| {
        Bank::of_data(members[..count].to_vec(), mixer(name, count)).unwrap().to_bytes().unwrap()
    };
    assert!(refused::<2>(&of(7, "mlpol")).contains("number of members"));
    assert!(refused::<2>(&of(8, "best")).contains("mixer"));
    assert!(refused::<2>(&members[0].to_bytes().unwrap()).contains("not a saved bank"));
    for length in 0..saved.len() {
        assert!(!refused::<2>(&saved[..length]).is_empty());
    }
    let mut altered = saved.clone();
    for i in 0..saved.len() {
        altered[i] ^= 0x20;
        assert!(!refused::<2>(&altered).is_empty());
        altered[i] ^= 0x20;
    }
}
