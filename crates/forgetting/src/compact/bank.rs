//! The default bank in as few numbers as there are: random walks of eight speeds, mixed by
//! [`mlpol`](crate::mixers::mlpol).
//!
//! It is the bank of [`crate::bank`] with compact members, of one row and one target: the same samples
//! give the same bits.

use super::{Compact, Walk};
use crate::bank::{mix, BankUpdate, Member, Members, Mixed, DEFAULT_NOISE, DEFAULT_PRIOR_RATIO};
use crate::covariance::DIFFUSE;
use crate::error::Error;
use crate::memory::state::Visitor;
use crate::memory::{Fixed, Packed, Size};
use crate::mixers::mlpol::Mlpol;
use crate::mixers::Mixer;
use crate::rates::Constant;
use crate::rules::Forgetting;
use crate::sample::{Noise, NoiseVariance};
use crate::saved::SavedMember;
use forgetting_kernels::Kernels;

/// How many members a compact bank has.
pub const MEMBERS: usize = DEFAULT_NOISE.len();
/// The registry names of what it is made of.
const RULE: &str = "random_walk";
const MIXER: &str = "mlpol";

/// The default bank of `N` parameters.
///
/// ```
/// use forgetting::compact::Bank;
///
/// let mut bank = Bank::<f32, 2>::of_walks(None, &[0.0; 2])?;
/// for k in 0..100 {
///     let phi = [1.0, (k % 7) as f32];
///     bank.update(&phi, 3.0 + 0.5 * phi[1])?;
/// }
/// assert!((bank.theta()[1] - 0.5).abs() < 1e-3);
/// # Ok::<(), forgetting::Error>(())
/// ```
pub type Bank<T, const N: usize> = Mixed<Walks<T, N>, Mlpol<Fixed<T, MEMBERS>>>;

/// A member.
type Walking<T, const N: usize> = Compact<Walk<Fixed<T, N>>, T, N>;

/// Random walks, one in the place of each of [`DEFAULT_NOISE`].
#[derive(Clone, Debug)]
pub struct Walks<T: Kernels, const N: usize>([Walking<T, N>; MEMBERS])
where
    Size<N>: Packed<T>;

impl<T: Kernels, const N: usize> Walks<T, N>
where
    Size<N>: Packed<T>,
{
    /// The default members, each with P₀ = `variance`·I and this θ₀.
    fn new(variance: T, theta: &[T; N]) -> Result<Self, Error> {
        let walking = |noise: f64| {
            let walk = Walk::new(T::from_f64(noise), Some(T::from_f64(DIFFUSE)))?;
            Compact::of(walk, Constant::new(T::ONE)?, variance, *theta)
        };
        let [a, b, c, d, e, f, g, h] = DEFAULT_NOISE.map(walking);
        Ok(Self([a?, b?, c?, d?, e?, f?, g?, h?]))
    }
}

impl<T: Kernels, const N: usize> Bank<T, N>
where
    Size<N>: Packed<T>,
{
    /// With P₀ = `initial_covariance`·I and θ₀, or following the units of the data without one.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and what is allowed; [`Error::Unsupported`] for a θ₀ other
    /// than 0 without an initial covariance, which says how far to trust it.
    pub fn of_walks(initial_covariance: Option<T>, initial_theta: &[T; N]) -> Result<Self, Error> {
        let follows_data = initial_covariance.is_none();
        if follows_data && initial_theta.iter().any(|&theta| theta != T::ZERO) {
            let reason = "initial_theta goes with initial_covariance: it says how far to trust it";
            return Err(Error::Unsupported { reason });
        }
        let variance = initial_covariance.unwrap_or(T::from_f64(DIFFUSE));
        let walks = Walks::new(variance, initial_theta)?;
        let mixer = Mlpol::new(T::from_f64(DEFAULT_PRIOR_RATIO), walks.weighed())?;
        Ok(Self::of_members(walks, mixer, follows_data))
    }

    /// Takes the sample of n numbers `phi` and the number `y`.
    ///
    /// # Errors
    /// [`Error`] names what was wrong, if no member can take the sample; the bank is as it was, bit for
    /// bit.
    pub fn update(&mut self, phi: &[T; N], y: T) -> Result<BankUpdate<'_, T>, Error> {
        self.update_in_steps(T::ONE, phi, &[y], Noise::Unit)
    }

    /// The same of a sample `elapsed` after the last one, the variance of its noise being `gamma`, or 1.
    ///
    /// # Errors
    /// Those of [`Bank::update`].
    pub fn update_after(
        &mut self,
        elapsed: T,
        phi: &[T; N],
        y: T,
        gamma: Option<T>,
    ) -> Result<BankUpdate<'_, T>, Error> {
        let noise = gamma.map_or(Noise::Unit, Noise::Scalar);
        self.update_in_steps(elapsed, phi, &[y], noise)
    }

    /// Gives the bank as bytes to `put`, piece by piece: those that any bank of the same members is saved
    /// as. Returns how many they are.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for what is not data; no bank of walks has it.
    pub fn save(&mut self, put: &mut dyn FnMut(&[u8])) -> Result<usize, Error> {
        self.save_as(MIXER, put)
    }

    /// The bank that was saved as these bytes.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with the bytes, or that they are not those of random walks of
    /// `N` parameters mixed by `mlpol`.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        Self::read(bytes, |name, parameters, members| {
            if name == MIXER {
                return Mlpol::configure(parameters, members);
            }
            Err(Error::State { reason: "its mixer is not mlpol" })
        })
    }
}

impl<T: Kernels, const N: usize> Members for Walks<T, N>
where
    Size<N>: Packed<T>,
{
    type Real = T;
    type Memory = Fixed<T, N>;
    type Weighed = Fixed<T, MEMBERS>;
    type Member = Walking<T, N>;
    type Numbers = [T; MEMBERS];
    type Flags = [bool; MEMBERS];
    type NoiseVariances = [NoiseVariance<T>; 0];

    const SEVERAL_ROWS: bool = false;

    fn gather(
        count: usize,
        mut next: impl FnMut() -> Result<Walking<T, N>, Error>,
    ) -> Result<Self, Error> {
        if count != MEMBERS {
            return Err(Error::State { reason: "it has another number of members" });
        }
        let mut walks = Self::new(T::ONE, &[T::ZERO; N])?;
        for member in &mut walks.0 {
            *member = next()?;
        }
        Ok(walks)
    }

    fn count(&self) -> usize {
        MEMBERS
    }

    fn memory(&self) -> Fixed<T, N> {
        Fixed::new()
    }

    fn weighed(&self) -> Fixed<T, MEMBERS> {
        Fixed::new()
    }

    fn is_weighted(&self) -> bool {
        false
    }

    fn numbers(&self, _: usize) -> [T; MEMBERS] {
        [T::ZERO; MEMBERS]
    }

    fn flags(&self) -> [bool; MEMBERS] {
        [true; MEMBERS]
    }

    fn noise_variances(&self, _: usize) -> [NoiseVariance<T>; 0] {
        []
    }

    fn each(&mut self) -> &mut [Walking<T, N>] {
        &mut self.0
    }

    fn visit_each(&self, mut visit: impl FnMut(usize, &Walking<T, N>)) {
        self.0.iter().enumerate().for_each(|(i, member)| visit(i, member));
    }

    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        self.0.iter_mut().for_each(|member| Member::visit(member, visitor));
    }

    fn theta(&self, weights: &[T], theta: &mut [T]) {
        mix(&self.0, weights, theta);
    }
}

impl<F, T, const N: usize> SavedMember<Fixed<T, N>> for Compact<F, T, N>
where
    F: Forgetting<Fixed<T, N>>,
    T: Kernels,
    Size<N>: Packed<T>,
{
    fn save(&mut self, put: &mut dyn FnMut(&[u8])) -> Result<usize, Error> {
        self.save(RULE, put)
    }

    fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        Self::from_bytes(RULE, bytes)
    }
}
