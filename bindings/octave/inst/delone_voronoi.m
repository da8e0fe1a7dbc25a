## delone_voronoi: the Voronoi cells of points, clipped to a box.
##
## [V, C, A] = delone_voronoi (P)
## [V, C, A] = delone_voronoi (P, BOX)
##
## BOX is [least x, least y, largest x, largest y]; without it the box is around all points, and a tenth of its larger side larger on each
## side. V has the vertices. C{i} has the rows of V that are the corners of the cell of point i, counter-clockwise; nothing for a
## point at the place of an earlier one. A has the areas of the cells.
##
## Example:
##
##   p = rand (50, 2);
##   [V, C, A] = delone_voronoi (p, [0 0 1 1]);
##   sum (A) # 1
##   cellfun (@(c) patch (V(c,1), V(c,2), rand (1, 3)), C);
##
## See also: delone_triangulation, voronoin.

function [V, C, A] = delone_voronoi (P, BOX = [])
  if (nargin < 1)
    print_usage ();
  endif
  [V, C, A] = __delone__ ("voronoi", __delone__ ("new", P), BOX);
endfunction

%!test
%! [V, C, A] = delone_voronoi ([1 1; 3 1; 1 3; 3 3; 1 1], [0 0 4 4]);
%! assert (A, [4; 4; 4; 4; 0]);
%! assert (numel (C), 5);
%! assert (isempty (C{5}));
%! assert (sortrows (V(C{1},:)), [0 0; 0 2; 2 0; 2 2]);

## Areas are those of the polygons.
%!test
%! p = rand (100, 2);
%! [V, C, A] = delone_voronoi (p, [0 0 1 1]);
%! assert (sum (A), 1, 1e-12);
%! assert (cellfun (@(c) polyarea (V(c,1), V(c,2)), C), A, 1e-12);

%!test
%! [~, ~, A] = delone_voronoi ([0 0; 2 0]);
%! assert (sum (A), 2.4 * .4, 1e-12);

%!error <box> delone_voronoi ([0 0; 1 1], [1 2])
%!error <row 1 is not finite> delone_voronoi ([NaN 0; 1 1])
