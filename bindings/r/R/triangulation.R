# Triangulations as handles: made, read, asked, changed.

METHODS <- c(linear = 0L, nearest = 1L, laplace = 2L, sibson = 3L)

# Points as a matrix of doubles. Strings and lists are refused, whole numbers become doubles.
as_points <- function(p, columns) {
  if (is.data.frame(p)) p <- as.matrix(p)
  if (!is.matrix(p)) p <- if (is.numeric(p) && length(p) == columns[1]) matrix(p, 1) else stop("a matrix of points is needed")
  if (!is.numeric(p)) stop("coordinates are numbers")
  if (!ncol(p) %in% columns) stop("a matrix of ", paste(columns, collapse = " or "), " columns is needed, not ", ncol(p))
  storage.mode(p) <- "double"
  unname(p)
}

as_indices <- function(i, columns) {
  if (columns > 1 && (!is.matrix(i) || ncol(i) != columns)) stop("a matrix of ", columns, " columns of indices is needed")
  if (!is.numeric(i) || any(i != round(i), na.rm = TRUE)) stop("indices are whole numbers")
  # Numbers that are no integer of R become NA, which the library refuses with their row.
  i[is.na(i) | abs(i) > .Machine$integer.max] <- NA
  storage.mode(i) <- "integer"
  i
}

triangulation <- function(p, segments = NULL, weights = NULL, crossings = c("refuse", "split")) {
  crossings <- match.arg(crossings)
  p <- as_points(p, c(2, 3))
  if (ncol(p) == 3 && !(is.null(segments) && is.null(weights))) stop("segments and weights are for points of the plane")
  if (!is.null(segments) && !is.null(weights)) stop("segments or weights, not both")
  if (!is.null(segments)) segments <- as_indices(segments, 2)
  if (!is.null(weights)) {
    if (!is.numeric(weights) || length(weights) != nrow(p)) stop("one weight a point is needed")
    weights <- as.double(weights)
    if (!all(is.finite(weights))) stop("weight ", which(!is.finite(weights))[1], " is not finite")
  }
  handle <- .Call(r_new, p, segments, weights, crossings == "split")
  structure(list(handle = handle, dimension = ncol(p)), class = "delone")
}

handle_of <- function(t) {
  if (!inherits(t, "delone")) stop("this is no triangulation: see ?triangulation")
  t$handle
}

print.delone <- function(x, ...) {
  counts <- .Call(r_counts, x$handle)
  kind <- if (x$dimension == 3) "tetrahedra" else "triangles"
  cat("A triangulation of ", counts["vertices"], " points: ", counts["simplices"], " ", kind, "\n", sep = "")
  invisible(x)
}

simplices <- function(t) .Call(r_simplices, handle_of(t))

neighbors <- function(t) .Call(r_neighbors, handle_of(t))

vertices <- function(t) .Call(r_points, handle_of(t))

edges <- function(t) {
  rows <- .Call(r_edges, handle_of(t))
  structure(rows[[1]], is_constraint = rows[[2]])
}

hull <- function(t) .Call(r_hull, handle_of(t))

locate <- function(t, places) as.vector(.Call(r_locate, handle_of(t), as_points(places, t$dimension)))

nearest <- function(t, places, k = 1) {
  found <- .Call(r_nearest, handle_of(t), as_points(places, t$dimension), as.integer(k))
  if (k == 1) as.vector(found) else found
}

interpolate <- function(t, z, places, method = c("linear", "nearest", "laplace", "sibson")) {
  method <- match.arg(method)
  if (!is.numeric(z)) stop("values are numbers")
  .Call(r_interpolate, handle_of(t), as.double(z), as_points(places, t$dimension), METHODS[[method]])
}

check <- function(t) {
  .Call(r_check, handle_of(t))
  invisible(TRUE)
}

insert_points <- function(t, p) as.vector(.Call(r_insert, handle_of(t), as_points(p, 2)))

remove_vertices <- function(t, v) {
  .Call(r_remove, handle_of(t), as_indices(v, 1))
  invisible(t)
}
