//! Every operation on the factor against the same operation on the dense matrix.

mod dense;

use dense::Dense;
use forgetting::{Dynamic, Error, Factor, Kernels};
use forgetting_kernels::kernel::layout;
use proptest::prelude::*;

/// Largest relative difference, in units of epsilon and, where P is inverted or multiplied, of
/// its condition number. Measured over 2000 cases of each test: less than 5.
const TOLERANCE: f64 = 30.0;

/// A factor that many operations have made, and vectors to use on it.
#[derive(Clone, Debug)]
struct Case {
    n: usize,
    variances: Vec<f64>,
    /// (which operation, a vector)
    history: Vec<(bool, Vec<f64>)>,
    x: Vec<f64>,
    c: f64,
}

fn case() -> impl Strategy<Value = Case> {
    (1..=20usize).prop_flat_map(|n| {
        let vector = || prop::collection::vec(-1.0..1.0f64, n);
        let variances = prop::collection::vec(0.1..10.0f64, n);
        let history = prop::collection::vec((any::<bool>(), vector()), 0..6);
        (variances, history, vector(), 0.01..5.0f64)
            .prop_map(move |(variances, history, x, c)| Case { n, variances, history, x, c })
    })
}

fn real<T: Kernels>(values: &[f64]) -> Vec<T> {
    values.iter().map(|&x| T::from_f64(x)).collect()
}

fn dense<T: Kernels>(rows: usize, values: &[T]) -> Dense {
    Dense::new(rows, &values.iter().map(|x| x.to_f64()).collect::<Vec<_>>())
}

fn column(x: &[f64]) -> Dense {
    Dense::new(x.len(), x)
}

impl Case {
    fn factor<T: Kernels>(&self) -> Factor<Dynamic<T>> {
        let memory = Dynamic::new(self.n, 1, 1).unwrap();
        let mut factor = Factor::diagonal(memory, &real(&self.variances)).unwrap();
        let mut gain = vec![T::ZERO; self.n];
        for (add_covariance, vector) in &self.history {
            let mut vector = real(vector);
            if *add_covariance {
                factor.reserve(T::ONE, T::from_f64(self.n as f64)).unwrap();
                factor.add_covariance(&mut vector, T::ONE);
            } else {
                factor.add_information(&vector, &mut gain);
            }
        }
        factor
    }

    /// x xᵀ, with x as the number type has it.
    fn dyad<T: Kernels>(&self) -> Dense {
        let x = dense(self.n, &real::<T>(&self.x));
        x.clone() * x.transpose()
    }
}

fn reconstruct<T: Kernels>(factor: &Factor<Dynamic<T>>) -> Dense {
    let n = factor.parameters();
    let mut p = vec![T::ZERO; n * n];
    factor.reconstruct(&mut p);
    dense(n, &p)
}

/// P, and that the factor is sound and its trace the trace of P.
fn sound<T: Kernels>(factor: &Factor<Dynamic<T>>) -> Dense {
    let p = reconstruct(factor);
    assert!(factor.is_sound());
    close::<T>(&Dense::new(1, &[factor.trace().to_f64()]), &Dense::new(1, &[p.trace()]), 1.0);
    let mut variances = vec![T::ZERO; factor.parameters()];
    factor.variances(&mut variances);
    let diagonal: Vec<f64> = (0..p.rows).map(|i| p.at(i, i)).collect();
    close::<T>(&dense(1, &variances), &Dense::new(1, &diagonal), 1.0);
    p
}

fn close<T: Kernels>(found: &Dense, wanted: &Dense, condition: f64) {
    let distance = found.distance(wanted) / (T::EPSILON.to_f64() * condition);
    assert!(distance < TOLERANCE, "{distance}: {found:?} is not {wanted:?}");
}

fn condition(p: &Dense) -> f64 {
    let values = p.eigenvalues();
    values[values.len() - 1] / values[0]
}

fn reads<T: Kernels>(case: &Case) {
    let factor = case.factor::<T>();
    let (n, p) = (case.n, sound(&factor));
    let (x, r, k) = (column(&case.x), p.inverse(), condition(&p));
    let x_real = real::<T>(&case.x);
    let scalar = |x: f64| Dense::new(1, &[x]);
    let applied = |apply: &dyn Fn(&mut [T])| {
        let mut y = x_real.clone();
        apply(&mut y);
        dense(n, &y)
    };
    let along_p = (x.transpose() * p.clone() * x.clone()).at(0, 0);
    close::<T>(&scalar(factor.leverage(&x_real).to_f64()), &scalar(along_p), k);
    let along_r = x.transpose() * r.clone() * x.clone();
    let found = factor.information_along(&x_real, &mut vec![T::ZERO; n]).to_f64();
    close::<T>(&scalar(found), &along_r, k);
    close::<T>(&applied(&|y| factor.multiply(&x_real, y)), &(p.clone() * x.clone()), k);
    // U D^(1/2) D^(1/2) Uᵀ
    let root = applied(&|y| {
        factor.apply_root_transposed(y);
        factor.apply_root(y);
    });
    close::<T>(&root, &(p * x), k);
    let half = applied(&|y| factor.apply_root_transposed(y));
    close::<T>(&(half.transpose() * half), &scalar(along_p), k);
    let (mut information, mut work) = (vec![T::ZERO; n * n], vec![T::ZERO; n * n]);
    factor.reconstruct_information(&mut information, &mut work);
    close::<T>(&dense(n, &information), &r, k);
}

fn adds<T: Kernels>(case: &Case) {
    let (n, start) = (case.n, case.factor::<T>());
    let (p, mut gain) = (reconstruct(&start), vec![T::ZERO; case.n]);
    let k = condition(&p);
    let c = T::from_f64(case.c);

    let mut factor = start.clone();
    factor.reserve(T::ONE, c * T::from_f64(n as f64)).unwrap();
    factor.add_covariance(&mut real(&case.x), c);
    close::<T>(&sound(&factor), &(p.clone() + c.to_f64() * case.dyad::<T>()), 1.0);

    let mut factor = start.clone();
    let measured = factor.add_information(&real(&case.x), &mut gain);
    let x = dense(n, &real::<T>(&case.x));
    let reach = p.clone() * x.clone();
    let s = (x.transpose() * reach.clone()).at(0, 0);
    close::<T>(&dense(n, &gain), &reach, k);
    close::<T>(&Dense::new(1, &[measured.leverage.to_f64()]), &Dense::new(1, &[s]), k);
    let variance = Dense::new(1, &[measured.variance.to_f64()]);
    close::<T>(&variance, &Dense::new(1, &[1.0 + s]), k);
    let wanted = p.clone() - (1.0 / (1.0 + s)) * (reach.clone() * reach.transpose());
    close::<T>(&sound(&factor), &wanted, k);

    let mut factor = start.clone();
    let variances: Vec<T> = real(&case.x.iter().map(|x| x.max(0.0)).collect::<Vec<_>>());
    factor.reserve(T::ONE, T::from_f64(n as f64)).unwrap();
    factor.add_diagonal(&variances, &mut gain);
    let added: Vec<f64> = variances.iter().map(|x| x.to_f64()).collect();
    close::<T>(&sound(&factor), &(p + Dense::diagonal(&added)), 1.0);
}

fn scales<T: Kernels>(case: &Case) {
    let (n, start) = (case.n, case.factor::<T>());
    let p = reconstruct(&start);

    let mut factor = start.clone();
    let growth = T::ONE + T::from_f64(case.c);
    factor.scale(growth).unwrap();
    close::<T>(&sound(&factor), &(growth.to_f64() * p.clone()), 1.0);

    let mut factor = start.clone();
    let scale: Vec<T> = real(&case.x.iter().map(|x| 0.3 + x.abs()).collect::<Vec<_>>());
    factor.reserve(T::from_f64(2.0), T::ZERO).unwrap();
    factor.scale_each(&scale);
    let s = Dense::diagonal(&scale.iter().map(|x| x.to_f64()).collect::<Vec<_>>());
    close::<T>(&sound(&factor), &(s.clone() * p.clone() * s), 1.0);

    let mut factor = start.clone();
    factor.hold_trace(T::from_f64(case.c));
    let wanted = (T::from_f64(case.c).to_f64() / p.trace()) * p;
    close::<T>(&sound(&factor), &wanted, n as f64);
}

fn replaces<T: Kernels>(case: &Case) {
    let (n, start) = (case.n, case.factor::<T>());
    let memory = start.memory();
    let p = reconstruct(&start);
    let k = condition(&p);
    let elements = |p: &Dense| real::<T>(&p.elements);
    close::<T>(&sound(&Factor::dense(memory, &elements(&p)).unwrap()), &p, k);

    let mut factor = Factor::scalar(memory, T::ONE).unwrap();
    factor.replace(&mut elements(&p), "p").unwrap();
    close::<T>(&sound(&factor), &p, k);
    factor.replace_information(&mut elements(&p.inverse()), |_| T::ZERO, "r").unwrap();
    close::<T>(&sound(&factor), &p, k);
    factor.scale(T::from_f64(3.0)).unwrap();
    factor.copy_from(&start);
    assert_eq!(reconstruct(&factor), p);

    // an indefinite matrix is refused, and P is as it was
    let mut wrong = elements(&p);
    wrong[n * n - 1] = -T::ONE;
    let refused = factor.replace(&mut wrong, "p");
    assert!(matches!(refused, Err(Error::Indefinite { parameter: "p", .. })));
    assert_eq!(reconstruct(&factor), p);
    let refused = factor.replace_information(&mut vec![T::ZERO; n * n], |_| T::ZERO, "r");
    assert!(matches!(refused, Err(Error::Indefinite { parameter: "r", .. })));
    assert_eq!(reconstruct(&factor), p);

    // two blocks, each with the triangle of the first
    let half = n / 2;
    let columns = start.packed_columns()[..layout::length::<T>(half)].to_vec();
    let diagonal = start.diagonal_elements()[..half].to_vec();
    factor.clear_columns();
    factor.put_block(0, &columns, &diagonal);
    factor.put_block(half, &columns, &diagonal);
    let block = reconstruct(&factor);
    for (i, j) in (0..half).flat_map(|i| (0..half).map(move |j| (i, j))) {
        assert_eq!(factor.unit(i, j).to_f64(), factor.unit(half + i, half + j).to_f64());
        let d = |k: usize| factor.diagonal_elements()[k].to_f64();
        assert_eq!(d(i), d(half + i));
        assert_eq!(block.at(i, half + j), 0.0);
    }
}

macro_rules! both {
    ($($name:ident: $check:ident,)*) => {
        proptest! {$(
            #[test]
            fn $name(case in case()) {
                $check::<f64>(&case);
                $check::<f32>(&case);
            }
        )*}
    };
}

both! {
    what_is_read_is_that_of_p: reads,
    what_is_added_is_added_to_p: adds,
    scaling_scales_p: scales,
    replacing_replaces_p: replaces,
}

#[test]
fn more_than_fits_is_refused_and_changes_nothing() {
    fn check<T: Kernels>() {
        let memory = Dynamic::<T>::new(3, 1, 1).unwrap();
        let mut factor = Factor::scalar(memory, T::from_f64(2.0)).unwrap();
        let before = reconstruct(&factor);
        for (growth, added) in [
            (T::CEILING, T::ZERO),
            (T::ONE, T::CEILING),
            (T::from_f64(f64::INFINITY), T::ZERO),
            (T::ONE, T::from_f64(f64::NAN)),
        ] {
            let refused = factor.reserve(growth, added);
            assert!(matches!(refused, Err(Error::Range { .. })));
            assert!(factor.is_sound());
        }
        assert!(factor.scale(T::CEILING).is_err());
        assert_eq!(reconstruct(&factor), before);
        // the bound is kept tight enough that P can come and go near the limit for ever
        let (large, row) = (T::CEILING * T::from_f64(0.1), [T::ONE, T::ZERO, T::ZERO]);
        for _ in 0..1000 {
            factor.reserve(T::ONE, large).unwrap();
            factor.add_covariance(&mut row.clone(), large);
            factor.add_information(&row, &mut [T::ZERO; 3]);
            assert!(factor.is_sound());
        }
    }
    check::<f64>();
    check::<f32>();
}
