## delone_delaunay: the Delaunay triangulation of points of the plane or of space, exact on every finite input.
##
## T = delone_delaunay (X, Y)
## T = delone_delaunay (X, Y, Z)
## T = delone_delaunay (P)
##
## As `delaunay`: each row of T has the indices of the corners of a triangle, counter-clockwise, or of a tetrahedron. P has two or
## three columns. Points at one place are one vertex, the first. Points on a line have no triangle: T is empty.
##
## Example:
##
##   x = rand (1, 100); y = rand (1, 100);
##   triplot (delone_delaunay (x, y), x, y);
##
## See also: delone_delaunayn, delone_triangulation, delaunay.

function T = delone_delaunay (varargin)
  switch (nargin)
    case 1
      T = delone_delaunayn (varargin{1});
    case {2, 3}
      count = cellfun (@numel, varargin);
      if (any (count != count(1)))
        error ("delone_delaunay: X, Y and Z have different numbers of elements");
      endif
      T = delone_delaunayn (cell2mat (cellfun (@(x) x(:), varargin, "UniformOutput", false)));
    otherwise
      print_usage ();
  endswitch
endfunction

%!function rows = sorted (T)
%!  rows = sortrows (sort (T, 2));
%!endfunction

%!test
%! assert (sorted (delone_delaunay ([0 1 0 1 .4], [0 0 1 1 .5])), [1 2 5; 1 3 5; 2 4 5; 3 4 5]);

## The set of triangles is that of delaunay.
%!test
%! rand ("seed", 42);
%! for n = [10, 100, 2000]
%!   x = rand (n, 1); y = rand (n, 1);
%!   assert (sorted (delone_delaunay (x, y)), sorted (delaunay (x, y)));
%! endfor

## Tetrahedra, too.
%!test
%! rand ("seed", 42);
%! p = rand (60, 3);
%! assert (sorted (delone_delaunay (p(:,1), p(:,2), p(:,3))), sorted (delaunayn (p)));

## Triangles are counter-clockwise, and duplicates are in none.
%!test
%! p = [rand(50, 2); .5 .5; .5 .5];
%! T = delone_delaunay (p);
%! a = p(T(:,1),:); b = p(T(:,2),:) - a; c = p(T(:,3),:) - a;
%! assert (all (b(:,1) .* c(:,2) > b(:,2) .* c(:,1)));
%! assert (! any (T(:) == 52));

%!assert (delone_delaunay (1:3, 1:3), zeros (0, 3))
%!error <row 2 is not finite> delone_delaunay ([0 NaN 1], [0 1 1])
%!error <different numbers> delone_delaunay ([0 1], [0 1 1])
%!error <real numbers> delone_delaunay ({1}, {2})
%!error <Invalid call> delone_delaunay ()
