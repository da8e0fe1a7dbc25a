# Functions with the names of those in geometry, interp and deldir.

delaunayn <- function(p, options = NULL, output.options = NULL, full = FALSE) {
  if (!is.null(output.options) || !identical(full, FALSE)) stop("areas and neighbours: see ?neighbors")
  if (!is.null(options)) warning("options are those of Qhull: they have no effect")
  simplices(triangulation(p))
}

interpp <- function(x, y, z, xo, yo, method = c("linear", "nearest", "laplace", "sibson")) {
  if (length(x) != length(z)) stop("x and z have different lengths")
  interpolate(triangulation(cbind(x, y)), z, cbind(xo, yo), match.arg(method))
}

interp <- function(x, y, z, xo = seq(min(x), max(x), length.out = nx), yo = seq(min(y), max(y), length.out = ny),
                   method = c("linear", "nearest", "laplace", "sibson"), nx = 40, ny = 40) {
  places <- cbind(rep(xo, times = length(yo)), rep(yo, each = length(xo)))
  values <- interpp(x, y, z, places[, 1], places[, 2], match.arg(method))
  list(x = xo, y = yo, z = matrix(values, length(xo), length(yo)))
}

voronoi <- function(p, box = NULL) {
  p <- as_points(p, 2)
  if (is.null(box)) {
    if (nrow(p) == 0) stop("a box is needed where there is no point")
    range <- apply(p, 2, range)
    if (all(is.finite(range))) {
      margin <- max(range[2, ] - range[1, ]) / 10
      box <- c(range[1, 1] - margin, range[2, 1] + margin, range[1, 2] - margin, range[2, 2] + margin)
    }
  } else if (!is.numeric(box) || length(box) != 4) {
    stop("box: least x, largest x, least y, largest y")
  }
  t <- triangulation(p)
  cells <- .Call(r_voronoi, t$handle, as.double(box[c(1, 3, 2, 4)]))
  starts <- cells[[1]]
  corners <- as.vector(cells[[2]])
  tiles <- lapply(seq_len(nrow(p)), function(i) {
    cells[[3]][corners[seq_len(starts[i + 1] - starts[i]) + starts[i]], , drop = FALSE]
  })
  tri <- simplices(t)
  area <- triangle_areas(p, tri)
  at <- function(values) {
    sums <- numeric(nrow(p))
    found <- rowsum(rep(values, 3), as.vector(tri))
    sums[as.integer(rownames(found))] <- found
    sums
  }
  ends <- edges(t)
  summary <- data.frame(x = p[, 1], y = p[, 2], n.tri = if (nrow(tri)) at(rep(1, nrow(tri))) else 0,
                        del.area = if (nrow(tri)) at(area / 3) else 0, n.corners = lengths(tiles) %/% 2L, dir.area = cells[[4]])
  result <- list(
    delsgs = data.frame(x1 = p[ends[, 1], 1], y1 = p[ends[, 1], 2], x2 = p[ends[, 2], 1], y2 = p[ends[, 2], 2],
                        ind1 = ends[, 1], ind2 = ends[, 2]),
    summary = summary, n.data = nrow(p), del.area = sum(area), dir.area = sum(cells[[4]]), rw = box, tiles = tiles,
    triangles = tri
  )
  structure(result, class = "delone_voronoi")
}

triangle_areas <- function(p, tri) {
  a <- p[tri[, 1], , drop = FALSE]
  b <- p[tri[, 2], , drop = FALSE] - a
  c <- p[tri[, 3], , drop = FALSE] - a
  (b[, 1] * c[, 2] - b[, 2] * c[, 1]) / 2
}

print.delone_voronoi <- function(x, ...) {
  cat("Voronoi cells of ", x$n.data, " points in the box ", paste(signif(x$rw, 6), collapse = " "), "\n", sep = "")
  print(utils::head(x$summary))
  invisible(x)
}
