# Planar straight line graphs and meshes, with the names of RTriangle.

is_given <- function(value) !is.null(value) && !(length(value) == 1 && is.na(value))

pslg <- function(P, PB = NA, PA = NA, S = NA, SB = NA, H = NA) {
  P <- as_points(P, 2)
  if (is_given(S)) S <- as_indices(S, 2) else S <- matrix(0L, 0, 2)
  PB <- if (is_given(PB)) as.integer(PB) else rep(0L, nrow(P))
  if (length(PB) != nrow(P)) stop("PB: one marker a point is needed")
  PA <- if (is_given(PA)) as.matrix(PA) else matrix(0, nrow(P), 0)
  storage.mode(PA) <- "double"
  if (nrow(PA) != nrow(P)) stop("PA: one row of attributes a point is needed")
  SB <- if (is_given(SB)) as.integer(SB) else rep(0L, nrow(S))
  if (length(SB) != nrow(S)) stop("SB: one marker a segment is needed")
  H <- if (is_given(H)) as_points(H, 2) else matrix(0, 0, 2)
  structure(list(P = P, PB = PB, PA = PA, S = S, SB = SB, H = H), class = "pslg")
}

triangulate <- function(p, a = NULL, q = NULL, Y = FALSE, j = FALSE, D = FALSE, S = Inf, V = 0, Q = TRUE,
                        crossings = c("refuse", "split")) {
  crossings <- match.arg(crossings)
  if (!inherits(p, "pslg")) p <- pslg(p)
  if (isTRUE(D)) stop("D: triangles of conforming Delaunay meshes are not available")
  if (is.logical(q)) q <- if (isTRUE(q)) 20 else NULL
  wishes <- list(
    split = as.double(crossings == "split"),
    # Without segments all of the hull; else without bays and holes.
    fill = if (nrow(p$S) > 0) 3 else 0,
    keep = if (isTRUE(Y)) 1 else 0,
    min_angle = if (is.null(q)) 0 else q,
    holes = if (nrow(p$H) > 0 && nrow(p$S) > 0) p$H
  )
  if (is.function(a)) {
    wishes$area_at <- a
  } else if (!is.null(a)) {
    wishes$max_area <- a
  }
  if (is.finite(S)) wishes$max_vertices <- S
  mesh <- structure(list(handle = .Call(r_mesh, p$P, p$S, wishes), dimension = 2), class = "delone")

  points <- vertices(mesh)
  corners <- simplices(mesh)
  ends <- edges(mesh)
  border <- hull(mesh)
  is_border <- key(ends, nrow(points)) %in% key(border, nrow(points))
  is_constraint <- attr(ends, "is_constraint")
  attr(ends, "is_constraint") <- NULL
  added <- seq_len(nrow(points)) > nrow(p$P)
  markers <- c(p$PB, rep(0L, sum(added)))
  on_border <- unique(as.vector(border))
  markers[on_border[markers[on_border] == 0L]] <- 1L
  result <- list(
    P = points, PB = markers, PA = attributes_of(p, points[added, , drop = FALSE]), T = corners,
    S = ends[is_constraint, , drop = FALSE], E = ends, EB = as.integer(is_border), H = p$H
  )
  if (isTRUE(j)) result <- without_unused(result)
  structure(result, class = "triangulation")
}

# Edges as numbers, whatever their direction.
key <- function(ends, count) pmin(ends[, 1], ends[, 2]) * (count + 1) + pmax(ends[, 1], ends[, 2])

# The attributes of all points: those of new ones linearly between the given ones.
attributes_of <- function(p, added) {
  if (ncol(p$PA) == 0 || nrow(added) == 0) return(rbind(p$PA, matrix(0, nrow(added), ncol(p$PA))))
  between <- if (nrow(p$S) > 0) triangulation(p$P, p$S, crossings = "split") else triangulation(p$P)
  extra <- nrow(vertices(between)) - nrow(p$P)
  values <- sapply(seq_len(ncol(p$PA)), function(k) {
    # At crossings there is no attribute: they get that of the nearest point.
    first <- triangulation(p$P)
    z <- c(p$PA[, k], if (extra > 0) p$PA[nearest(first, vertices(between)[nrow(p$P) + seq_len(extra), , drop = FALSE]), k])
    found <- interpolate(between, z, added, "linear")
    # A rounded point of the border may be outside of it.
    lost <- is.nan(found)
    if (any(lost)) found[lost] <- interpolate(between, z, added[lost, , drop = FALSE], "nearest")
    found
  })
  rbind(p$PA, matrix(values, nrow(added)))
}

# Without points that are in no triangle.
without_unused <- function(r) {
  kept <- sort(unique(as.vector(r$T)))
  rows <- match(seq_len(nrow(r$P)), kept)
  renamed <- function(m) matrix(rows[m], nrow(m), ncol(m))
  keeps <- function(m) rowSums(is.na(renamed(m))) == 0
  r$P <- r$P[kept, , drop = FALSE]
  r$PB <- r$PB[kept]
  r$PA <- r$PA[kept, , drop = FALSE]
  r$EB <- r$EB[keeps(r$E)]
  r$E <- renamed(r$E[keeps(r$E), , drop = FALSE])
  r$S <- renamed(r$S[keeps(r$S), , drop = FALSE])
  r$T <- renamed(r$T)
  r
}
