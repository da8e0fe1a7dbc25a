//! Voronoi diagrams of higher order: how large they are, how large all up to an order are, how many pairs of sites share a
//! region (Lemma 4.3 and the remark on it), how many regions are unbounded (k-sets), and what an order takes.

use std::collections::BTreeSet;
use std::hint::black_box;

use delone::{Delaunay2, OrderK2};
use delone_generators::Kind;

use super::plot::Plot;
use super::table::short;
use super::{Error, Findings, Options, decades, timed};

/// The orders shown.
const ORDERS: [usize; 6] = [1, 2, 3, 4, 5, 8];

/// How often each is made; the fastest counts.
const RUNS: usize = 3;

/// `delone-lab experiment order-k`: from a hundred points on.
pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut table = options.table(
        "order-k",
        "Voronoi diagrams of order k: sizes, pairs of sites in one region, time (§4.2, Lemma 4.3)",
        &[
            "set",
            "points",
            "k",
            "regions / n",
            "2k - 1 - (k^2 - 1 + k-sets below) / n",
            "circles / n",
            "circles of all orders <= k / (n k^2)",
            "k-sets",
            "pairs / (n k)",
            "us / n",
        ],
    );
    let title = "Pairs of sites that share a region of order k, in units of n k";
    let mut plot = Plot::new("order-k", title, ["points n", "pairs / (n k)"]);
    for kind in [Kind::Uniform, Kind::Clusters, Kind::Circle] {
        let mut curves = vec![Vec::new(); ORDERS.len()];
        for n in decades(100, options.largest) {
            let d = Delaunay2::from_points(&kind.points(n, options.seed))?;
            let count = d.vertex_count() as f64;
            // Of all orders below, and up to this one.
            let (mut unbounded, mut total) = (0, 0);
            for k in 1..=ORDERS[ORDERS.len() - 1] {
                let (order, mut seconds) = timed(|| d.order(k));
                let order = order?;
                for _ in 1..RUNS {
                    seconds = seconds.min(timed(|| d.order(k).map(|order| _ = black_box(order.order()))).1);
                }
                let expected = (2 * k - 1) as f64 - (k * k - 1 + unbounded) as f64 / count;
                let sets = order.regions().filter(|region| !region.is_bounded()).count();
                unbounded += sets;
                let circles = order.circles().count();
                total += circles;
                let Some(shown) = ORDERS.iter().position(|&shown| shown == k) else { continue };
                let pairs = pairs(&order) as f64 / count / k as f64;
                let cells = [
                    order.region_count() as f64 / count,
                    expected,
                    circles as f64 / count,
                    total as f64 / count / (k * k) as f64,
                    sets as f64,
                    pairs,
                    seconds * 1e6 / count,
                ];
                let row = [kind.name().to_owned(), n.to_string(), k.to_string()];
                table.row(row.into_iter().chain(cells.map(short)));
                curves[shown].push((n as f64, pairs));
            }
        }
        if kind == Kind::Uniform {
            for (k, curve) in ORDERS.iter().zip(curves).filter(|(k, _)| **k > 1) {
                plot.curve(&format!("k = {k}"), curve);
            }
        }
    }
    Ok(Findings { tables: vec![table], plots: vec![plot] })
}

/// How many pairs of sites are together in some region; those of lower orders are among them.
fn pairs(order: &OrderK2) -> usize {
    let mut pairs = BTreeSet::new();
    for region in order.regions() {
        let sites = region.sites();
        pairs.extend(sites.iter().enumerate().flat_map(|(i, &v)| sites[..i].iter().map(move |&w| (w, v))));
    }
    pairs.len()
}
