//! An estimator in as few numbers as there are, as firmware would have it: what it takes, and its state as
//! bytes that go on elsewhere.

use forgetting::choice::Defaults;
use forgetting::saved::AnyEstimator;
use forgetting::{Compact, Error, Fixed, Subspace};

type Cell = Compact<Subspace<Fixed<f32, 2>>, f32, 2>;

fn main() -> Result<(), Error> {
    let mut cell = Cell::new(&Defaults, 0.99, 100.0, &[3.6, 0.0])?;
    for k in 0..1000_u16 {
        let current = 2.0 + f32::from(k % 11) / 10.0;
        cell.update(&[1.0, -current], 3.7 - 0.05 * current)?;
    }
    let theta = *cell.theta();
    println!("{:.3} V, {:.1} mOhm in {} bytes", theta[0], 1e3 * theta[1], size_of::<Cell>());

    let mut bytes = Vec::new();
    cell.save("subspace", &mut |piece| bytes.extend_from_slice(piece))?;
    let elsewhere = AnyEstimator::<f32>::from_bytes(&bytes)?;
    assert_eq!(*elsewhere.theta(), theta);
    println!("{} bytes saved, the same estimator on the heap", bytes.len());
    Ok(())
}
