## delone_mesh: a mesh of triangles inside of segments, with bounds for angles, areas and edges.
##
## [P, T] = delone_mesh (P, C, NAME, VALUE, ...)
##
## C has two indices of points a segment; with an empty C all of the hull is meshed. Points of the result begin with those given; T
## has the triangles. Names, none of which is needed:
##
##   "min_angle"    degrees, below 60; up to 30 is usually reached
##   "max_area"     the largest area, or a function f (x, y) of it
##   "max_edge"     the longest edge
##   "min_edge"     no edge with a new vertex is shorter
##   "holes"        a point in each hole, in rows
##   "fill"         what is inside: "seeds" (without holes, and bays of the hull), "all", "even-odd", "nonzero"
##   "keep"         "nothing", "border" (no new vertex there), "constraints" (no new vertex on any segment)
##   "crossings"    "refuse", "split" (segments that cross get a vertex there)
##   "unsuitable"   a function f (CORNERS, AREA): true if the triangle must get smaller
##   "max_vertices" new ones: with so many the mesh is done, whatever is still wished
##
## Example:
##
##   square = [0 0; 4 0; 4 4; 0 4];
##   [P, T] = delone_mesh (square, [1 2; 2 3; 3 4; 4 1], "min_angle", 30, "max_area", .1);
##   triplot (T, P(:,1), P(:,2));
##
## See also: delone_triangulation.

function [P, T] = delone_mesh (P, C = [], varargin)
  if (nargin < 1 || mod (numel (varargin), 2) != 0)
    print_usage ();
  endif
  fills = {"all", "even-odd", "nonzero", "seeds"};
  keeps = {"nothing", "border", "constraints"};
  wishes = struct ("split", 0, "fill", 3 * ! isempty (C), "keep", 0, "min_angle", 0, "max_area", 0, "max_edge", 0, "min_edge", 0,
                   "max_vertices", 0, "holes", zeros (0, 2), "area_at", [], "unsuitable", []);
  for k = 1:2:numel (varargin)
    [name, value] = varargin{k:k+1};
    switch (name)
      case {"min_angle", "max_edge", "min_edge", "max_vertices"}
        validateattributes (value, {"numeric"}, {"scalar", "nonnegative"});
        wishes.(name) = value;
      case "max_area"
        if (is_function_handle (value))
          wishes.area_at = value;
        else
          validateattributes (value, {"numeric"}, {"scalar", "nonnegative"});
          wishes.max_area = value;
        endif
      case "holes"
        validateattributes (value, {"numeric"}, {"2d", "ncols", 2});
        wishes.holes = value;
      case "fill"
        wishes.fill = position (value, fills, name);
      case "keep"
        wishes.keep = position (value, keeps, name);
      case "crossings"
        wishes.split = position (value, {"refuse", "split"}, name);
      case "unsuitable"
        wishes.unsuitable = value;
      otherwise
        error ("delone_mesh: \"%s\" is unknown", name);
    endswitch
  endfor
  if (rows (wishes.holes) > 0 && wishes.fill != 3)
    error ("delone_mesh: holes are of \"fill\", \"seeds\"");
  endif
  t = __delone__ ("mesh", P, C, wishes);
  P = __delone__ ("points", t);
  T = __delone__ ("simplices", t);
endfunction

function number = position (value, all, name)
  number = find (strcmp (value, all)) - 1;
  if (isempty (number))
    error ("delone_mesh: \"%s\" is one of %s", name, strjoin (all, ", "));
  endif
endfunction

%!function sum_of = area (P, T)
%!  a = P(T(:,1),:); b = P(T(:,2),:) - a; c = P(T(:,3),:) - a;
%!  sum_of = sum (b(:,1) .* c(:,2) - b(:,2) .* c(:,1)) / 2;
%!endfunction

%!shared square, rings, outer
%! square = [0 0; 4 0; 4 4; 0 4; 1 1; 3 1; 3 3; 1 3];
%! outer = [1 2; 2 3; 3 4; 4 1];
%! rings = [outer; outer + 4];

%!test
%! [P, T] = delone_mesh (square, rings, "holes", [2 2], "min_angle", 30, "max_area", .1);
%! assert (area (P, T), 12, 1e-12);
%! assert (P(1:8,:), square);
%! assert (rows (T) >= 120);

%!test
%! [P, T] = delone_mesh (square, rings, "fill", "even-odd");
%! assert (area (P, T), 12, 1e-12);
%! assert (rows (P), 8);

%!test
%! [P, T] = delone_mesh (square, rings, "max_area", @(x, y) .02 + x / 10);
%! [Q, U] = delone_mesh (square, rings, "max_area", .42);
%! assert (rows (T) > rows (U));

%!test
%! [P, T] = delone_mesh (square, rings, "unsuitable", @(corners, area) area > .05);
%! assert (rows (T) >= 320);

%!test
%! [P, T] = delone_mesh ([0 0; 1 0; 1 1; 0 1], [1 3; 2 4], "crossings", "split", "fill", "all");
%! assert (P(5,:), [.5 .5]);
%! assert (rows (T), 4);

%!error <mine> delone_mesh (square, rings, "max_area", @(x, y) error ("mine"))
%!error <segment> delone_mesh ([0 0; 1 0; 1 1; 0 1], [1 3; 2 4])
%!error <row 2 of the segments> delone_mesh (square, [1 2; 1 0])
%!error <row 1> delone_mesh (square, [1 9])
%!error <unknown> delone_mesh (square, rings, "min_angel", 30)
%!error <is one of> delone_mesh (square, rings, "fill", "some")
