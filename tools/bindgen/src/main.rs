//! `bindgen INPUT.wasm FOLDER`: writes `forgetting.js`, `forgetting_bg.wasm` and the types into the folder.

use std::env;
use std::process::ExitCode;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let [input, folder] = arguments.as_slice() else {
        eprintln!("usage: bindgen INPUT.wasm FOLDER");
        return ExitCode::from(2);
    };
    match write(input, folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{input}: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn write(input: &str, folder: &str) -> Result<(), Box<dyn std::error::Error>> {
    let mut bindgen = Bindgen::new();
    bindgen.input_path(input).out_name("forgetting").web(true)?.typescript(true);
    // init() finds the other file beside the module
    bindgen.omit_default_module_path(false);
    bindgen.remove_producers_section(true).generate(folder)?;
    Ok(())
}
