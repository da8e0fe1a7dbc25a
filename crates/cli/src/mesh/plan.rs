//! Plans: the criteria of a mesh and the form of its files, by options or by Triangle's switches.

use delone::{Constrained2, Keep, Layers2, Placement, Refinement};

use super::quads::Wanted;
use crate::args::{CrossingsName, KeepName, LayerArgs, MeshArgs, PlacementName, Switches};
use crate::message::{Failure, note};

/// Whether something that files can hold is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Written {
    /// If the input has it.
    AsGiven,
    Always,
    Never,
}

/// The plan of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) min_angle: f64,
    pub(super) max_area: Option<f64>,
    pub(super) max_edge: Option<f64>,
    pub(super) min_edge: Option<f64>,
    /// The length that edges are to have, and how it may grow.
    pub(super) edge: Option<f64>,
    pub(super) growth: Option<f64>,
    pub(super) max_vertices: Option<usize>,
    pub(super) keep: Keep,
    placement: Placement,
    /// Boundary layers, on which segments ever.
    pub(super) layers: Option<Layers2>,
    /// Rounds of smoothing, and those of quadrilaterals.
    pub(super) smooth: usize,
    pub(super) smooth_quads: usize,
    /// The treatment of segments that cross.
    pub(super) crossings: CrossingsName,
    /// Whether the regions of triangles are written.
    pub(super) regions: Written,
    /// Whether the markers of points and segments are.
    pub(super) markers: Written,
    /// The type of elements in `.inp` files.
    pub(super) element: Option<String>,
    /// The number of the first point, if not as in the input.
    pub(super) base: Option<usize>,
    pub(super) traits: Traits,
}

/// Yes-or-no parts of the plan.
#[derive(Clone, Copy, Debug)]
#[allow(clippy::struct_excessive_bools)] // they are switches
pub(super) struct Traits {
    pub(super) conforming: bool,
    /// Whether regions have largest areas of their own.
    pub(super) region_areas: bool,
    pub(super) convex: bool,
    pub(super) ignore_holes: bool,
    pub(super) second_order: bool,
    pub(super) quads: Wanted,
    pub(super) drop_unused: bool,
    pub(super) check: bool,
    pub(super) histogram: bool,
}

impl Plan {
    /// The plan of a command line, if it can be done.
    pub(super) fn of(args: &MeshArgs, quiet: bool) -> Result<Self, Failure> {
        let plan = match &args.triangle {
            Some(switches) => Self::of_switches(args, switches, quiet)?,
            None => Self::of_options(args),
        };
        // Wrong numbers are refused before anything is read.
        plan.refinement().run(&mut Constrained2::new()).map_err(|error| {
            Failure::usage(error.to_string().replace('_', "-"), "give a number in that range")
        })?;
        Ok(plan)
    }

    fn of_options(args: &MeshArgs) -> Self {
        Self {
            min_angle: args.min_angle.unwrap_or(20.0),
            max_area: args.max_area,
            max_edge: args.max_edge,
            min_edge: args.min_edge,
            edge: args.edge,
            growth: args.growth,
            max_vertices: args.max_vertices,
            keep: match args.keep {
                Some(KeepName::Border) => Keep::Border,
                Some(KeepName::Constraints) => Keep::Constraints,
                Some(KeepName::Nothing) | None => Keep::Nothing,
            },
            placement: placement(args),
            layers: layers(&args.layers),
            smooth: args.smooth.unwrap_or_default(),
            smooth_quads: args.smooth.unwrap_or(ROUNDS_FOR_QUADS),
            crossings: args.graph.crossings.unwrap_or(CrossingsName::Refuse),
            regions: Written::AsGiven,
            markers: Written::AsGiven,
            element: args.element.clone(),
            base: None,
            traits: Traits {
                conforming: args.conforming,
                region_areas: true,
                convex: args.convex,
                ignore_holes: args.ignore_holes,
                second_order: args.second_order,
                quads: quads(args),
                drop_unused: args.drop_unused,
                check: args.check,
                histogram: args.histogram,
            },
        }
    }

    fn of_switches(args: &MeshArgs, switches: &Switches, quiet: bool) -> Result<Self, Failure> {
        for (letter, why) in switches.ignored() {
            note(quiet, format_args!("the switch {letter} is ignored ({why})"));
        }
        if switches.has('u') && args.size.is_none() {
            return Err(Failure::usage(
                "the switch u is for a size of one's own, and none is named",
                "name a file of points with the longest edges wanted there, as in --size sizes.csv",
            ));
        }
        if switches.has('r') && switches.has('I') {
            return Err(Failure::usage(
                "with the switches r and I the mesh that is read would be written over",
                "leave one of them out",
            ));
        }
        Ok(Self {
            min_angle: switches.min_angle.unwrap_or(0.0),
            max_area: switches.max_area,
            max_edge: args.max_edge,
            min_edge: args.min_edge,
            edge: args.edge,
            growth: args.growth,
            max_vertices: switches.max_vertices,
            keep: match switches.count('Y') {
                0 => Keep::Nothing,
                1 => Keep::Border,
                _ => Keep::Constraints,
            },
            placement: placement(args),
            layers: layers(&args.layers),
            smooth: args.smooth.unwrap_or_default(),
            smooth_quads: args.smooth.unwrap_or(ROUNDS_FOR_QUADS),
            crossings: args.graph.crossings.unwrap_or(CrossingsName::Split),
            regions: match (switches.has('A'), switches.has('r')) {
                (true, _) => Written::Always,
                (_, true) => Written::AsGiven,
                _ => Written::Never,
            },
            markers: if switches.has('B') { Written::Never } else { Written::Always },
            element: args.element.clone(),
            base: switches.has('z').then_some(0),
            traits: Traits {
                conforming: switches.has('D'),
                region_areas: switches.has_areas && !switches.has('r'),
                convex: switches.has('c'),
                ignore_holes: switches.has('O'),
                second_order: switches.has('o'),
                quads: quads(args),
                drop_unused: switches.has('j'),
                check: args.check || switches.has('C'),
                histogram: args.histogram || switches.has('V'),
            },
        })
    }

    /// The criteria for the library; the inside, and sizes by place, come from files.
    pub(super) fn refinement(&self) -> Refinement<'_> {
        let mut wanted = Refinement::new()
            .min_angle(self.min_angle)
            .smooth(self.smooth)
            .keep(self.keep)
            .placement(self.placement)
            .conforming(self.traits.conforming);
        if let Some(area) = self.max_area {
            wanted = wanted.max_area(area);
        }
        if let Some(length) = self.max_edge {
            wanted = wanted.max_edge(length);
        }
        if let Some(length) = self.min_edge {
            wanted = wanted.min_edge(length);
        }
        if let Some(length) = self.edge {
            wanted = wanted.edge(length);
        }
        if let Some(ratio) = self.growth {
            wanted = wanted.growth(ratio);
        }
        if let Some(count) = self.max_vertices {
            wanted = wanted.max_vertices(count);
        }
        if let Some(layers) = &self.layers {
            wanted = wanted.layers(layers);
        }
        wanted
    }
}

/// Rounds of smoothing for quadrilaterals, if nothing is said: more change little.
const ROUNDS_FOR_QUADS: usize = 5;

/// Where new vertices go.
fn placement(args: &MeshArgs) -> Placement {
    match args.placement {
        Some(PlacementName::Circumcenter) => Placement::Circumcenter,
        Some(PlacementName::Offcenter) | None => Placement::OffCenter,
    }
}

/// Which cells are to have four corners.
fn quads(args: &MeshArgs) -> Wanted {
    match (args.all_quads, args.quads) {
        (true, _) => Wanted::All,
        (false, true) => Wanted::Pairs,
        (false, false) => Wanted::Nothing,
    }
}

/// The rows, if nothing is said.
const ROWS: usize = 5;

/// Boundary layers, if any are wanted.
fn layers(args: &LayerArgs) -> Option<Layers2> {
    let height = args.layer_height?;
    let mut layers = Layers2::new(height, args.layer_count.unwrap_or(ROWS));
    layers.growth = args.layer_growth.unwrap_or(layers.growth);
    layers.thickness = args.layer_thickness;
    Some(layers)
}
