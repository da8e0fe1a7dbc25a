## delone_delaunayn: the Delaunay triangulation of points of the plane or of space, exact on every finite input.
##
## T = delone_delaunayn (P)
##
## As `delaunayn`: P has a row a point, of two or three columns. Each row of T has the indices of the corners of a simplex.
##
## Example:
##
##   T = delone_delaunayn (rand (100, 3));
##   size (T)
##
## See also: delone_delaunay, delaunayn.

function T = delone_delaunayn (P)
  if (nargin != 1)
    print_usage ();
  endif
  T = __delone__ ("simplices", __delone__ ("new", P));
endfunction

## The tetrahedra fill the hull.
%!test
%! p = [0 0 0; 1 0 0; 0 1 0; 0 0 1; 1 1 1; .3 .3 .3];
%! T = delone_delaunayn (p);
%! volume = arrayfun (@(i) abs (det (p(T(i,2:4),:) - p(T(i,1),:))) / 6, 1:rows (T));
%! [~, expected] = convhulln (p);
%! assert (sum (volume), expected, 1e-12);

%!assert (rows (delone_delaunayn ([0 0; 1 0; 0 1])), 1)
%!error <2 columns> delone_delaunayn (rand (5, 4))
%!error <row 3 is not finite> delone_delaunayn ([0 0 0; 1 1 1; 2 Inf 0])
