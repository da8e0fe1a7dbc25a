# Tests of the package; geometry and deldir are judges where they are installed.
library(delone)

sorted <- function(tri) {
  tri <- t(apply(tri, 1, sort))
  tri[do.call(order, as.data.frame(tri)), , drop = FALSE]
}
refuses <- function(expression, words) {
  message <- tryCatch({
    expression
    "nothing"
  }, error = conditionMessage)
  if (!grepl(words, message)) stop("not refused with ", words, ": ", message)
}
area <- function(p, tri) {
  b <- p[tri[, 2], ] - p[tri[, 1], ]
  c <- p[tri[, 3], ] - p[tri[, 1], ]
  sum(b[, 1] * c[, 2] - b[, 2] * c[, 1]) / 2
}
set.seed(7)
p <- matrix(runif(400), ncol = 2)
q <- matrix(runif(150), ncol = 3)

# The same simplices as geometry's.
stopifnot(nrow(delaunayn(p)) > 300, nrow(delaunayn(cbind(1:3, 1:3))) == 0, ncol(delaunayn(q)) == 4)
if (requireNamespace("geometry", quietly = TRUE)) {
  stopifnot(identical(sorted(delaunayn(p)), sorted(geometry::delaunayn(p))))
  stopifnot(identical(sorted(delaunayn(q)), sorted(geometry::delaunayn(q))))
}
stopifnot(identical(delaunayn(matrix(c(0L, 4L, 0L, 0L, 0L, 4L), 3)), delaunayn(data.frame(c(0, 4, 0), c(0, 0, 4)))))

# Errors name the row, from 1.
refuses(delaunayn(rbind(c(0, 0), c(1, NaN), c(1, 1))), "row 2 of the points is not finite")
refuses(delaunayn(rbind(c(0, 0), c(1, 1), c(NA, 1))), "row 3")
refuses(delaunayn(rbind(c(0, 0, 0), c(1, Inf, 1))), "row 2")
refuses(delaunayn(matrix("a", 2, 2)), "numbers")
refuses(delaunayn(matrix(0, 3, 5)), "2 or 3 columns")
fault <- tryCatch(delaunayn(rbind(c(0, NA))), delone_error = function(e) e)
stopifnot(fault$row == 1, fault$status == "not finite")

# Handles.
t <- triangulation(p)
stopifnot(check(t), identical(vertices(t), p), nrow(edges(t)) == nrow(p) + nrow(simplices(t)) - 1)
stopifnot(sum(is.na(neighbors(t))) == nrow(hull(t)))
tri <- simplices(t)
middle <- (p[tri[, 1], ] + p[tri[, 2], ] + p[tri[, 3], ]) / 3
stopifnot(identical(locate(t, middle), seq_len(nrow(tri))), is.na(locate(t, cbind(9, 9))))
distances <- outer(middle[1:50, 1], p[, 1], "-")^2 + outer(middle[1:50, 2], p[, 2], "-")^2
stopifnot(identical(nearest(t, middle[1:50, ]), apply(distances, 1, which.min)))
stopifnot(identical(nearest(t, middle[1:50, ], 3)[, 3], apply(distances, 1, function(d) order(d)[3])))
stopifnot(is.na(nearest(triangulation(p[1:2, ]), middle, 3)[1, 3]))
for (method in c("linear", "laplace", "sibson")) {
  stopifnot(all.equal(interpolate(t, p %*% c(2, 3), middle, method), c(middle %*% c(2, 3))))
}
refuses(interpolate(t, 1, middle), "")
added <- insert_points(t, rbind(c(.5, .5), c(.25, .75)))
stopifnot(identical(added, c(201L, 202L)), nearest(t, cbind(.5, .5)) == 201)
remove_vertices(t, added)
stopifnot(identical(sorted(simplices(t)), sorted(tri)))
refuses(remove_vertices(t, 0), "row 1 of the vertices")
refuses(simplices(1), "no triangulation")
file <- tempfile()
saveRDS(t, file)
refuses(simplices(readRDS(file)), "another session")
unlink(file)
s <- triangulation(q)
stopifnot(check(s), nearest(s, q[7, , drop = FALSE]) == 7, is.na(locate(s, cbind(9, 9, 9))))
refuses(edges(s), "of the plane")

# Weights hide points.
square <- cbind(c(0, 4, 4, 0), c(0, 0, 4, 4))
stopifnot(nrow(simplices(triangulation(rbind(square, c(2, 2)), weights = c(0, 0, 0, 0, -100)))) == 2)
refuses(triangulation(square, weights = c(0, NaN, 0, 0)), "weight 2 is not finite")

# Segments.
refuses(triangulation(square, rbind(c(1, 3), c(2, 4))), "segment [12] crosses")
refuses(triangulation(square, rbind(c(1, 2), c(2, 9))), "row 2 of the segments")
refuses(triangulation(square, rbind(c(0, 2))), "row 1 of the segments")
split <- triangulation(square, rbind(c(1, 3), c(2, 4)), crossings = "split")
stopifnot(identical(vertices(split)[5, ], c(2, 2)), sum(attr(edges(split), "is_constraint")) == 4)

# Meshes.
ring <- cbind(1:4, c(2:4, 1))
graph <- pslg(rbind(square, 1 + square / 2), S = rbind(ring, ring + 4), H = cbind(2, 2), PA = 1:8, PB = c(5, rep(0, 7)))
mesh <- triangulate(graph, a = 0.1, q = 30)
stopifnot(all.equal(area(mesh$P, mesh$T), 12), nrow(mesh$T) >= 120, identical(mesh$P[1:8, ], graph$P))
stopifnot(nrow(mesh$PA) == nrow(mesh$P), !anyNA(mesh$PA), mesh$PB[1:2] == c(5, 1), sum(mesh$EB) == nrow(mesh$S))
whole <- triangulate(graph, a = 0.1, Y = TRUE)
stopifnot(nrow(whole$S) == 8)
graded <- triangulate(graph, a = function(x, y) 0.02 + x / 10)
stopifnot(nrow(graded$T) > nrow(triangulate(graph, a = 0.42)$T))
refuses(triangulate(graph, a = function(x, y) stop("mine")), "mine")
refuses(triangulate(graph, a = function(x, y) "large"), "gave no number")
refuses(triangulate(graph, q = 75), "angle")
refuses(triangulate(graph, D = TRUE), "conforming")
stopifnot(nrow(triangulate(square)$T) == 2)
loose <- triangulate(pslg(rbind(square, c(9, 9)), S = ring), j = TRUE)
stopifnot(nrow(loose$P) == 4, nrow(loose$T) == 2, nrow(loose$S) == 4)

# Cells.
v <- voronoi(p, c(0, 1, 0, 1))
stopifnot(all.equal(v$dir.area, 1), identical(lengths(v$tiles) > 5, rep(TRUE, 200)))
stopifnot(all.equal(sum(v$summary$del.area), v$del.area), sum(v$summary$n.tri) == 3 * nrow(v$triangles))
if (requireNamespace("deldir", quietly = TRUE)) {
  other <- suppressMessages(deldir::deldir(p[, 1], p[, 2], rw = c(0, 1, 0, 1), digits = 15))
  stopifnot(all.equal(v$summary$dir.area, other$summary$dir.area))
}
twice <- voronoi(rbind(square, square[1, ]))
stopifnot(twice$summary$dir.area[5] == 0, twice$summary$n.tri[5] == 0)
refuses(voronoi(p, 1:3), "box")
refuses(voronoi(rbind(c(0, 0), c(NA, 1))), "row 2")

# Values.
plane <- interp(p[, 1], p[, 2], p %*% c(2, 3), xo = c(.4, .5, .6), yo = c(.4, .5), method = "sibson")
stopifnot(all.equal(plane$z, outer(2 * c(.4, .5, .6), 3 * c(.4, .5), "+")))
stopifnot(is.nan(interpp(p[, 1], p[, 2], p[, 1], 5, 5)))
