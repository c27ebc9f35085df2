//! Blocks of streams of at most ten parameters.

use super::storage::{Layout, Line};
use super::{few, report, rows, units, Advance};
use crate::kernel::dispatch::Kernel;
use crate::number::vector::{StreamVector, Vector};
use crate::number::Real;

/// How many blocks ahead memory is asked for one.
const AHEAD: usize = 2;

/// Takes samples of `N` parameters that forget in one form.
pub struct Few<'a, 's, 'o, T: Real, const N: usize, const FORM: u8>(pub Advance<'a, 's, 'o, T>);

impl<T: Real, const N: usize, const FORM: u8> Kernel<T> for Few<'_, '_, '_, T, N, FORM> {
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        self.0.size()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> usize {
        advance::<T, V, N, FORM>(self.0)
    }
}

#[inline(always)]
fn advance<T: Real, V: Vector<T>, const N: usize, const FORM: u8>(
    task: Advance<'_, '_, '_, T>,
) -> usize {
    let Advance { streams: part, samples, outputs } = task;
    let (lanes, with_leverage) = (Line::<T>::LANES, outputs.leverage.is_some());
    let last = part.strengths.len() - 1;
    let length = Layout::new(N).length();
    let regressors = samples.phi.as_chunks::<N>().0.chunks(lanes);
    let (mut used, mut rest) = (0, &mut *part.lines);
    for (block, rows) in regressors.enumerate() {
        let (lines, later) = rest.split_at_mut(length);
        // a block is long: without this, memory waits until it is done
        if let Some(lines) = later.get((AHEAD - 1) * length..AHEAD * length) {
            for line in lines {
                V::StreamVector::prefetch(line);
            }
        }
        rest = later;
        let streams = block * lanes..block * lanes + rows.len();
        let strength = part.strengths[block.min(last)].0.as_ref();
        let y = rows::outputs(&samples, streams.clone());
        let mut report = report::Report::new();
        for lane in (0..lanes).step_by(V::StreamVector::COUNT) {
            let mut phi = rows::columns(rows, lane);
            if let Some(units) = &mut part.units {
                let lines = &mut units.lines[block * 3 * N..(block + 1) * 3 * N];
                units::Block { lines, lane }.measure(&mut phi);
            }
            let state = few::State::<T, V::StreamVector, N>::of(lines, lane);
            let strength = V::StreamVector::read(&strength[lane..]);
            let y = V::StreamVector::read(&y.0.as_ref()[lane..]);
            let outcome = few::advance::<_, _, N, FORM>(
                state,
                (part.form, strength),
                (&phi, y),
                with_leverage,
            );
            report.note(lane, &outcome);
            if let Some(units) = &mut part.units {
                let lines = &mut units.lines[block * 3 * N..(block + 1) * 3 * N];
                let mut units = units::Block { lines, lane };
                // once more, so that it need not be kept until now where there are no units
                let mut phi = rows::columns(rows, lane);
                units.measure(&mut phi);
                units.learn::<V::StreamVector, N>(&phi, outcome.codes);
            }
        }
        part.offered[block] += 1;
        if let Some(units) = &mut part.units {
            report.count_unmeasured(&mut units.unmeasured[streams.clone()]);
        }
        used += report.write(part.unused, outputs, streams);
    }
    used
}
