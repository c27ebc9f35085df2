//! The Python module `forgetting._core`: it converts between Python and the crate
//! `forgetting-runtime`, and does nothing else.

mod arrays;
mod bank;
mod bank_update;
mod bounds;
mod callable;
mod choice;
mod conversion;
mod errors;
mod fleet;
mod intervals;
mod model;
mod pickle;
mod prediction;
mod registry;
mod rls;
mod run;
mod samples;
mod settings;
mod shared;
mod time;
mod update;
mod window;

use pyo3::prelude::*;

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    arrays::load(module.py())?;
    module.add_class::<rls::Rls>()?;
    module.add_class::<bank::Bank>()?;
    module.add_class::<bank_update::BankUpdate>()?;
    module.add_class::<fleet::Fleet>()?;
    module.add_class::<fleet::FleetUpdate>()?;
    module.add_class::<update::Update>()?;
    module.add_class::<callable::Evidence>()?;
    module.add_class::<window::InformationWindow>()?;
    module.add_class::<run::Run>()?;
    module.add_class::<model::SignalModel>()?;
    module.add_class::<intervals::Intervals>()?;
    module.add_function(wrap_pyfunction!(intervals::bounded, module)?)?;
    module.add("InvalidInput", module.py().get_type::<errors::InvalidInput>())?;
    module.add("NumericalRange", module.py().get_type::<errors::NumericalRange>())?;
    module.add("SKIPPED", registry::skip_codes(module.py())?)?;
    module.add("GATE", registry::gate_codes(module.py())?)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(arrays::numbers, module)?)?;
    module.add_function(wrap_pyfunction!(model::structures, module)?)?;
    module.add_function(wrap_pyfunction!(registry::axes, module)?)?;
    module.add_function(wrap_pyfunction!(registry::bounds, module)?)
}
