//! A model as bytes.
//!
//! | part | content |
//! |---|---|
//! | mark | `FGMOD` |
//! | version | one byte |
//! | method | one byte: 0 for prediction errors, 1 for extended least squares |
//! | constant | one byte, 0 or 1; 2 more where something is known of parameters |
//! | orders | na, nc, nd and the number of inputs; nb, nf, nk of each; 16 bits each |
//! | known | if so, of each parameter: a byte (0 nothing, 1 a prior, 2 a fixed value) and the value |
//! | numbers | of the state, in the order of `visit` |
//! | check | CRC-32 of all before it |

use super::read::Reader;
use super::write::Output;
use super::{unaltered, Error, Vec};
use crate::models::{Given, InputOrders, Method, Orders, Polynomial};

const MARK: &[u8; 5] = b"FGMOD";
const VERSION: u8 = 1;
/// Added to the byte of the constant.
const INFORMED: u8 = 2;

impl Polynomial {
    /// The model, orders and state, as bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut keep = |piece: &[u8]| bytes.extend_from_slice(piece);
        let mut output = Output::new(&mut keep);
        let (orders, method) = (self.orders(), self.method() as u8);
        output.bytes(MARK);
        let informed = u8::from(self.is_informed()) * INFORMED;
        output.bytes(&[VERSION, method, u8::from(orders.constant) + informed]);
        let mut put = |order: usize| output.bytes(&(order as u16).to_le_bytes());
        [orders.na, orders.nc, orders.nd, orders.inputs.len()].into_iter().for_each(&mut put);
        for input in &orders.inputs {
            [input.nb, input.nf, input.nk].into_iter().for_each(&mut put);
        }
        for given in self.given().iter().filter(|_| self.is_informed()) {
            let kind = match given {
                Given::Nothing => 0,
                Given::Prior(_) => 1,
                Given::Fixed(_) => 2,
            };
            output.bytes(&[kind]);
            output.bytes(&given.value().to_le_bytes());
        }
        self.clone().visit(&mut output);
        output.finish();
        bytes
    }

    /// The model that [`Polynomial::to_bytes`] saved, bit for bit.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with the bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        if !bytes.starts_with(MARK) {
            return Err(Error::State { reason: "it is not a saved model" });
        }
        let mut reader = Reader::new(&unaltered(bytes, VERSION)?[MARK.len() + 1..]);
        let (method, flags) = (method(reader.byte()?)?, reader.byte()?);
        let (constant, informed) = (flags % INFORMED == 1, flags >= INFORMED);
        let (na, nc, nd) = (reader.count()?, reader.count()?, reader.count()?);
        let mut orders = Orders { na, nc, nd, inputs: Vec::new(), constant };
        for _ in 0..reader.count()? {
            let (nb, nf, nk) = (reader.count()?, reader.count()?, reader.count()?);
            orders.inputs.push(InputOrders { nb, nf, nk });
        }
        let mut model = Self::new(orders, method)?;
        if informed {
            let count = model.orders().parameters();
            let known: Result<Vec<Given>, Error> = (0..count).map(|_| given(&mut reader)).collect();
            model = model.knowing(&known?)?;
        }
        model.visit(&mut reader);
        reader.finish()?;
        match model.is_sound() {
            true => Ok(model),
            false => Err(Error::State { reason: "its numbers are not those of a model" }),
        }
    }
}

fn given(reader: &mut Reader<'_>) -> Result<Given, Error> {
    let (kind, value) = (reader.byte()?, reader.real()?);
    match kind {
        0 => Ok(Given::Nothing),
        1 => Ok(Given::Prior(value)),
        2 => Ok(Given::Fixed(value)),
        _ => Err(Error::State { reason: "what is known of a parameter is of an unknown kind" }),
    }
}

fn method(byte: u8) -> Result<Method, Error> {
    match byte {
        0 => Ok(Method::PredictionError),
        1 => Ok(Method::ExtendedLeastSquares),
        _ => Err(Error::State { reason: "its method is not known" }),
    }
}
