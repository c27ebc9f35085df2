//! What the compiler made of the kernels: nothing in them is a call but what stops the program.
//!
//! A function with vector instructions puts all of its registers into memory before a call, and what it
//! calls works on numbers there, often without those instructions. Nothing else shows that: the
//! results are right. So this test reads the machine code of its own binary.
#![cfg(target_arch = "x86_64")]

use forgetting::Kernels;
use forgetting_cpu::Fused;
use std::collections::{BTreeSet, HashMap};
use std::process::Command;

/// All kernels, so that they are part of this binary.
fn kernels<T: Kernels>() -> Vec<*const ()> {
    vec![
        T::dot as *const (),
        T::add_scaled as *const (),
        T::arrive as *const (),
        T::leverage as *const (),
        T::measure as *const (),
        T::agee_turner as *const (),
        T::solve as *const (),
        T::multiply as *const (),
        T::multiply_transposed as *const (),
        T::symmetric_multiply as *const (),
        T::symmetric_subtract as *const (),
        T::variances as *const (),
        T::trace as *const (),
        T::advance as *const (),
        T::advance_streams as *const (),
        T::predict_streams as *const (),
        T::advance_together as *const (),
        T::mix_thetas as *const (),
        T::scale_rows as *const (),
        T::sum_roots as *const (),
        T::watch_run as *const (),
        T::watch_one as *const (),
        T::update_eigenvectors as *const (),
    ]
}

/// Parts of the names of what a kernel may call: the ends of a program that went wrong, and what
/// happens hardly ever and is compiled apart so that it takes no room.
const ALLOWED: [&str; 5] =
    ["core::panicking::", "_fail", "core::option::unwrap_failed", "::lift", "::add_up"];

/// The machine code of this binary, and where its calls through a table of addresses lead.
struct Code {
    text: String,
    /// the names of functions by address
    names: HashMap<u64, String>,
    /// the addresses or names of functions by the place in the table
    table: HashMap<u64, String>,
}

impl Code {
    /// None where the program that reads machine code is missing.
    fn read() -> Option<Self> {
        let run = |options: &[&str]| {
            let binary = std::env::current_exe().ok()?;
            let output = Command::new("objdump").args(options).arg(binary).output().ok()?;
            String::from_utf8(output.stdout).ok()
        };
        let text = run(&["--disassemble", "--demangle", "--no-show-raw-insn"])?;
        let names = text.lines().filter_map(head).map(|(at, name)| (at, name.to_owned())).collect();
        let table = run(&["--dynamic-reloc"])?
            .lines()
            .filter_map(|line| {
                let mut words = line.split_whitespace();
                let place = u64::from_str_radix(words.next()?, 16).ok()?;
                Some((place, words.nth(1)?.to_owned()))
            })
            .collect();
        Some(Self { text, names, table })
    }

    /// Who calls whom, by name.
    fn calls(&self) -> Vec<(&str, &str)> {
        let (mut calls, mut caller, mut registers) = (Vec::new(), "", HashMap::new());
        for line in self.text.lines() {
            if let Some((_, name)) = head(line) {
                caller = name;
                registers.clear();
            } else if let Some(operand) = called(line) {
                let known = operand.strip_prefix('*').and_then(|name| registers.get(name));
                calls.push((caller, known.copied().unwrap_or_else(|| self.callee(operand))));
            } else if let Some((place, register)) = loaded(line) {
                registers.insert(register, self.callee(place));
            }
        }
        calls
    }

    /// The name of what is called so: directly, or through the table.
    fn callee<'a>(&'a self, operand: &'a str) -> &'a str {
        let Some((_, place)) = operand.split_once("# ") else {
            return operand.split_once('<').map_or(operand, |(_, name)| name);
        };
        let place = place.split_whitespace().next().unwrap_or_default();
        let target = u64::from_str_radix(place, 16).ok().and_then(|place| self.table.get(&place));
        let Some(target) = target else { return operand };
        match target.strip_prefix("*ABS*+0x").map(|address| u64::from_str_radix(address, 16)) {
            Some(Ok(address)) => self.names.get(&address).map_or(operand, String::as_str),
            _ => target,
        }
    }
}

/// What is called, or jumped to outside of a function: a call whose return is left to the callee.
fn called(line: &str) -> Option<&str> {
    if let Some((_, operand)) = line.split_once("\tcall") {
        return Some(operand.trim());
    }
    let (_, operand) = line.split_once("\tjmp")?;
    let outside = operand.contains("# ") || operand.contains('<') && !operand.contains("+0x");
    outside.then_some(operand.trim())
}

/// A place in the table, and the register that is loaded from it, to be called later.
fn loaded(line: &str) -> Option<(&str, &str)> {
    let (_, operands) = line.split_once("\tmov ")?;
    let register = operands.split_once('#')?.0.rsplit_once(',')?.1.trim();
    Some((line, register))
}

/// Address and name, in the line above a function.
fn head(line: &str) -> Option<(u64, &str)> {
    let (address, name) = line.strip_suffix(">:")?.split_once(" <")?;
    Some((u64::from_str_radix(address, 16).ok()?, name))
}

fn is_kernel(name: &str) -> bool {
    name.contains("::run_wide") || name.contains("::run_fused")
}

#[test]
fn no_kernel_calls_anything() {
    std::hint::black_box((kernels::<Fused<f64>>(), kernels::<Fused<f32>>()));
    if cfg!(debug_assertions) {
        println!("not checked: this is not the optimized code");
        return;
    }
    let Some(code) = Code::read() else {
        println!("not checked: objdump is missing");
        return;
    };
    let kernels = code.names.values().filter(|name| is_kernel(name)).count();
    assert!(kernels >= 60, "{kernels} kernels found");
    let allowed = |callee: &str| ALLOWED.iter().any(|part| callee.contains(part));
    let detects = |caller: &str| caller.contains("detect");
    let faults: BTreeSet<_> = code
        .calls()
        .into_iter()
        .filter(|&(caller, callee)| {
            let instruction = callee.contains("core_arch::x86") && !detects(caller);
            instruction || is_kernel(caller) && !is_kernel(callee) && !allowed(callee)
        })
        .collect();
    assert!(faults.is_empty(), "{faults:#?}");
}
