//! Bare coordinates in JSON, as libraries of polygons take them: `[[[0,0],[4,0],[0,4]]]`.
//!
//! Three arrays in each other are a polygon, four are several. Rings are closed whether or not their first position comes
//! again at their end. Two arrays are positions, which may be points, a line or a ring: they are taken as points, and refused
//! where segments are asked for.

use serde_json::Value;

use crate::formats::shapes::Shapes;
use crate::{Error, Source};

pub(super) fn read(source: Box<dyn Source>, as_points: bool) -> Result<Shapes, Error> {
    let all: Value = serde_json::from_reader(source).map_err(|error| wrong(&error.to_string()))?;
    let all = array(&all)?;
    let mut shapes = Shapes::default();
    match depth(all) {
        1 if as_points => all.iter().try_for_each(|position| take(position, &mut shapes))?,
        1 => {
            return Err(wrong(
                "positions alone may be points, a line or a ring: put a ring into an array more",
            ));
        }
        2 => polygon(all, &mut shapes)?,
        3 => all.iter().try_for_each(|each| polygon(array(each)?, &mut shapes))?,
        _ => return Err(wrong("an array that is neither positions nor rings nor polygons")),
    }
    Ok(shapes)
}

fn wrong(what: &str) -> Error {
    Error::content(format!("JSON: {what}"))
}

fn array(value: &Value) -> Result<&Vec<Value>, Error> {
    value.as_array().ok_or_else(|| wrong(&format!("{} where an array is expected", kind(value))))
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "an array",
        Value::Object(_) => "an object",
    }
}

/// How many arrays the first number in an array is in, below it.
fn depth(all: &[Value]) -> usize {
    let inner = all.iter().find_map(Value::as_array);
    inner.map_or(0, |inner| 1 + depth(inner))
}

fn polygon(rings: &[Value], shapes: &mut Shapes) -> Result<(), Error> {
    shapes.polygon();
    for ring in rings {
        let start = shapes.len();
        array(ring)?.iter().try_for_each(|position| take(position, shapes))?;
        shapes.ring(start, true);
    }
    Ok(())
}

fn take(position: &Value, shapes: &mut Shapes) -> Result<(), Error> {
    let at = shapes.len();
    let numbers: Option<Vec<f64>> = array(position)?.iter().take(3).map(Value::as_f64).collect();
    let is_whole = numbers.is_some_and(|numbers| shapes.position(&numbers));
    is_whole.then_some(()).ok_or_else(|| wrong(&format!("position {at} is not two or three numbers")))
}
