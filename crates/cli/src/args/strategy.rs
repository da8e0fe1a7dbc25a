//! How points are located: a strategy and its parameters, for `triangulate`, `locate`, `nearest` and others.
//!
//! A parameter that the chosen strategy does not have is refused by its name.

use clap::{Args, ValueEnum};
use delone::{Hierarchy, JumpAndWalk, Locate, Nearest, Walk};

use super::count;
use crate::message::Failure;

/// The strategy and its parameters.
#[derive(Debug, Args)]
#[command(next_help_heading = "Point location")]
pub struct StrategyArgs {
    /// Point location; the results are the same [default: tree; spatial for triangulate].
    #[arg(long, value_name = "NAME")]
    pub(crate) locate: Option<LocateName>,
    /// Seed of whatever is randomized; it changes the course, not the result.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Of hierarchy: how many times smaller each level is than the one below [default: 30].
    #[arg(long, value_name = "ALPHA", allow_negative_numbers = true)]
    ratio: Option<f64>,
    /// Of hierarchy: the largest number of levels, the triangulation itself included [default: unlimited].
    #[arg(long, value_name = "K")]
    levels: Option<usize>,
    /// Of hierarchy: the least number of vertices of a level that is used [default: 20].
    #[arg(long, value_name = "N", value_parser = count)]
    smallest_level: Option<usize>,
    /// Of hierarchy: the least number of vertices of a highest level that is sampled, or never [default: 20].
    #[arg(long, value_name = "N")]
    smallest_sampled: Option<Least>,
    /// Of jump-and-walk and hierarchy: the factor of the sample size RHO n^(1/3), in space RHO n^(1/4) [default: 1].
    #[arg(long, value_name = "RHO", allow_negative_numbers = true)]
    rho: Option<f64>,
    /// Of jump-and-walk: the sample size itself.
    #[arg(long, value_name = "M", value_parser = count, conflicts_with = "rho")]
    sample: Option<usize>,
    /// Of jump-and-walk and hierarchy: a vertex may be drawn twice.
    #[arg(long)]
    with_replacement: bool,
    /// Of hierarchy: which vertex of a level the search below starts from [default: corner].
    #[arg(long, value_name = "WHICH")]
    phase3: Option<Phase3>,
    /// Of walk and hierarchy: how to walk [default: visibility; straight in a hierarchy of the plane].
    #[arg(long, value_name = "WALK")]
    walk: Option<WalkName>,
}

/// Point location strategies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LocateName {
    /// A k-d tree of hints: the fastest for any set and any change.
    Tree,
    /// Walk from the vertex inserted last.
    Walk,
    /// Walk from the nearest of n^(1/3) random vertices.
    JumpAndWalk,
    /// Descend through triangulations of random samples (the Delaunay hierarchy).
    Hierarchy,
    /// Split, flip, and trace all triangles that ever were; no removal. In space in bulk only.
    History,
    /// A history without triangles that came and went in one insertion, by binary search; no removal.
    Stars,
    /// Search all triangles that ever were by their circles (the Delaunay tree).
    DelaunayTree,
    /// Triangles keep lists of the points to come; bulk only.
    Conflict,
    /// Walk from the previous point in spatial order; bulk only.
    Spatial,
}

/// Phase 3 of the hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Phase3 {
    /// The nearest corner of the triangle found (the modified phase).
    Corner,
    /// The nearest vertex, by distances and angles.
    Exact,
    /// The nearest vertex, by in-circle tests; in the plane.
    InCircle,
}

/// Walks from triangle to triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WalkName {
    /// Across any edge that has the goal beyond it.
    Visibility,
    /// A visibility walk that tests edges in random order; in the plane.
    Stochastic,
    /// Along the straight line; in the plane.
    Straight,
}

/// A least number, or never.
#[derive(Clone, Copy, Debug)]
struct Least(Option<usize>);

impl std::str::FromStr for Least {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "never" { Ok(Self(None)) } else { count(text).map(|n| Self(Some(n))) }
    }
}

/// The name of an option.
fn name(value: impl ValueEnum) -> String {
    value.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

impl StrategyArgs {
    /// The strategy of choice, or else this one.
    pub(crate) fn name_or(&self, default: LocateName) -> LocateName {
        self.locate.unwrap_or(default)
    }

    /// The strategy of choice, or else this one, for a triangulation that changes; `None` if it is for building in bulk.
    pub(crate) fn strategy(&self, default: LocateName) -> Result<Option<Locate>, Failure> {
        let chosen = self.name_or(default);
        if let Some((option, having)) = self.given().find(|(_, having)| !having.contains(&chosen)) {
            let having: Vec<String> = having.iter().map(|&having| name(having)).collect();
            return Err(Failure::usage(
                format!("{option} is no parameter of --locate {}", name(chosen)),
                format!("choose --locate {}, or leave {option} out", having.join(" or ")),
            ));
        }
        let seed = self.seed;
        Ok(Some(match chosen {
            LocateName::Tree => Locate::Tree,
            LocateName::Walk => Locate::Walk(self.walk().unwrap_or_default()),
            LocateName::JumpAndWalk => Locate::JumpAndWalk(
                JumpAndWalk::default()
                    .rho(self.rho.unwrap_or(JumpAndWalk::default().rho))
                    .sample(self.sample)
                    .with_replacement(self.with_replacement)
                    .seed(seed),
            ),
            LocateName::Hierarchy => Locate::Hierarchy(self.hierarchy()),
            LocateName::History => Locate::History,
            LocateName::Stars => Locate::Stars,
            LocateName::DelaunayTree => Locate::DelaunayTree,
            LocateName::Conflict | LocateName::Spatial => return Ok(None),
        }))
    }

    /// Refuses all parameters: `what` has none.
    pub(crate) fn refuse(&self, what: &str) -> Result<(), Failure> {
        match self.given().next() {
            None => Ok(()),
            Some((option, having)) => Err(Failure::usage(
                format!("{option} is no parameter of {what}"),
                format!("choose --algorithm incremental --locate {}, or leave it out", name(having[0])),
            )),
        }
    }

    /// The option that the library means when it refuses a strategy.
    pub fn refused(&self, error: &delone::Error) -> Failure {
        let help = "see the --help of the command";
        match (error, self.phase3, self.walk) {
            (delone::Error::Parameter { name, value, range }, ..) => {
                Failure::usage(format!("--{} is {value}; it must be {range}", name.replace('_', "-")), help)
            }
            (delone::Error::OnlyInThePlane, Some(Phase3::InCircle), _) => {
                Failure::usage("--phase3 in-circle is for the plane", "choose --phase3 exact or corner")
            }
            (delone::Error::OnlyInThePlane, _, Some(walk)) if walk != WalkName::Visibility => Failure::usage(
                format!("--walk {} is for the plane", name(walk)),
                "in space the walk is by visibility",
            ),
            _ => Failure::usage(error, help),
        }
    }

    /// The parameters given, each with the strategies that have it.
    fn given(&self) -> impl Iterator<Item = (&'static str, &'static [LocateName])> {
        const HIERARCHY: &[LocateName] = &[LocateName::Hierarchy];
        const SAMPLED: &[LocateName] = &[LocateName::JumpAndWalk, LocateName::Hierarchy];
        const WALKED: &[LocateName] = &[LocateName::Walk, LocateName::Hierarchy];
        let all: [(&str, bool, &[LocateName]); 9] = [
            ("--ratio", self.ratio.is_some(), HIERARCHY),
            ("--levels", self.levels.is_some(), HIERARCHY),
            ("--smallest-level", self.smallest_level.is_some(), HIERARCHY),
            ("--smallest-sampled", self.smallest_sampled.is_some(), HIERARCHY),
            ("--rho", self.rho.is_some(), SAMPLED),
            ("--sample", self.sample.is_some(), &[LocateName::JumpAndWalk]),
            ("--with-replacement", self.with_replacement, SAMPLED),
            ("--phase3", self.phase3.is_some(), HIERARCHY),
            ("--walk", self.walk.is_some(), WALKED),
        ];
        all.into_iter().filter(|option| option.1).map(|(option, _, having)| (option, having))
    }

    fn hierarchy(&self) -> Hierarchy {
        let default = Hierarchy::default();
        Hierarchy::default()
            .ratio(self.ratio.unwrap_or(default.ratio))
            .levels(self.levels.or(default.levels))
            .smallest_level(self.smallest_level.unwrap_or(default.smallest_level))
            .smallest_sampled(self.smallest_sampled.map_or(default.smallest_sampled, |least| least.0))
            .rho(self.rho.unwrap_or(default.rho))
            .with_replacement(self.with_replacement)
            .nearest(match self.phase3 {
                None | Some(Phase3::Corner) => Nearest::Corner,
                Some(Phase3::Exact) => Nearest::Exact,
                Some(Phase3::InCircle) => Nearest::InCircle,
            })
            .walk(self.walk())
            .seed(self.seed)
    }

    fn walk(&self) -> Option<Walk> {
        self.walk.map(|walk| match walk {
            WalkName::Visibility => Walk::Visibility,
            WalkName::Stochastic => Walk::Stochastic { seed: self.seed },
            WalkName::Straight => Walk::Straight,
        })
    }
}
