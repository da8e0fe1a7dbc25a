//! A way to attack: what an input is a list of, how one is made, and how it is judged.

use std::fmt::Debug;

use delone_generators::Random;

/// Nothing, or what is wrong.
pub(crate) type Judgement = Result<(), String>;

/// A way to attack.
pub(crate) trait Attack {
    /// An item of the input.
    type Item: Clone + Debug;

    /// A random input. It must not call the engine: the supervisor makes the input of a crash, too.
    fn make(random: &mut Random) -> Vec<Self::Item>;

    /// Runs the engine on an input and compares it with the definition. Whatever else is random comes from the seed.
    fn judge(items: &[Self::Item], seed: u64) -> Judgement;
}
