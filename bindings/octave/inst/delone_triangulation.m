classdef delone_triangulation

  ## delone_triangulation: a Delaunay triangulation that is kept, and asked.
  ##
  ## t = delone_triangulation (P)
  ## t = delone_triangulation (P, C)
  ## t = delone_triangulation (P, C, "split")
  ##
  ## As `delaunayTriangulation` of Matlab. P has two or three columns; C has two indices of points of the plane a segment, which becomes
  ## an edge. Segments that cross are an error, or get a vertex with "split".
  ##
  ##   t.Points, t.ConnectivityList, t.Constraints
  ##   pointLocation (t, Q)         the row of the triangle of each place, NaN outside
  ##   nearestNeighbor (t, Q)       the nearest point of each place, and its distance
  ##   nearestNeighbors (t, Q, K)   the K nearest
  ##   interpolate (t, V, Q, METHOD) "linear", "nearest", "laplace", "natural"
  ##   neighbors (t)                the triangles across from each corner, NaN for none
  ##   edges (t), freeBoundary (t)  edges, and those of the hull (in space triangles)
  ##   isInterior (t)               for each triangle, whether an odd number of constraints is around it
  ##   check (t)                    proves that it is Delaunay, or is an error
  ##
  ## Example:
  ##
  ##   t = delone_triangulation (rand (1000, 2));
  ##   pointLocation (t, [.5 .5; 2 2])
  ##   [v, d] = nearestNeighbor (t, [.5 .5])
  ##
  ## See also: delone_delaunay, delone_voronoi.

  properties (SetAccess = private)
    Points = zeros (0, 2);
    ConnectivityList = zeros (0, 3);
    Constraints = zeros (0, 2);
  endproperties

  properties (Access = private)
    handle = [];
  endproperties

  methods

    function t = delone_triangulation (P, C = [], how = "refuse")
      if (nargin < 1)
        print_usage ();
      endif
      if (! any (strcmp (how, {"refuse", "split"})))
        error ("delone_triangulation: \"refuse\" or \"split\"");
      endif
      if (columns (P) == 3 && ! isempty (C))
        error ("delone_triangulation: segments are for points of the plane");
      endif
      t.handle = __delone__ ("new", P, C, strcmp (how, "split"));
      t.ConnectivityList = __delone__ ("simplices", t.handle);
      t.Points = P;
      if (columns (P) == 2)
        t.Points = __delone__ ("points", t.handle);
        t.Constraints = __delone__ ("constraints", t.handle);
      endif
    endfunction

    function rows = pointLocation (t, Q)
      rows = __delone__ ("locate", t.handle, Q);
    endfunction

    function [v, d] = nearestNeighbor (t, Q)
      v = nearestNeighbors (t, Q, 1);
      if (nargout > 1)
        d = norm (t.Points(v,:) - Q, 2, "rows");
      endif
    endfunction

    function v = nearestNeighbors (t, Q, K)
      v = __delone__ ("nearest", t.handle, Q, K);
    endfunction

    function VQ = interpolate (t, V, Q, method = "linear")
      number = find (strcmp (method, {"linear", "nearest", "laplace", "natural"}));
      if (isempty (number))
        error ("delone_triangulation: the method is linear, nearest, laplace or natural");
      endif
      VQ = __delone__ ("interpolate", t.handle, V, Q, number - 1);
    endfunction

    function rows = neighbors (t)
      rows = __delone__ ("neighbors", t.handle);
    endfunction

    function ends = edges (t)
      ends = __delone__ ("edges", t.handle);
    endfunction

    function facets = freeBoundary (t)
      facets = __delone__ ("hull", t.handle);
    endfunction

    function inside = isInterior (t)
      inside = false (rows (t.ConnectivityList), 1);
      across = neighbors (t);
      corners = t.ConnectivityList;
      count = rows (t.Points);
      is_wall = @(a, b) ismember (min (a, b) * (count + 1) + max (a, b), min (t.Constraints, [], 2) * (count + 1) + max (t.Constraints, [], 2));
      wall = [is_wall(corners(:,2), corners(:,3)), is_wall(corners(:,3), corners(:,1)), is_wall(corners(:,1), corners(:,2))];
      ## By layers from outside: behind a constraint is the other side.
      depth = NaN (rows (corners), 1);
      [row, k] = find (isnan (across));
      depth(row(wall(sub2ind (size (wall), row, k)))) = 1;
      depth(row(! wall(sub2ind (size (wall), row, k)))) = 0;
      front = unique (row);
      while (! isempty (front))
        next = [];
        for k = 1:3
          others = across(front,k);
          isnew = ! isnan (others);
          isnew(isnew) = isnan (depth(others(isnew)));
          depth(others(isnew)) = mod (depth(front(isnew)) + wall(front(isnew),k), 2);
          next = [next; others(isnew)];
        endfor
        front = unique (next);
      endwhile
      inside = depth == 1;
    endfunction

    function check (t)
      __delone__ ("check", t.handle);
    endfunction

    function disp (t)
      printf ("  triangulation of %d points: %d simplices\n", rows (t.Points), rows (t.ConnectivityList));
    endfunction

  endmethods

endclassdef

%!shared p, t
%! rand ("seed", 7);
%! p = rand (300, 2);
%! t = delone_triangulation (p);
%!assert (sortrows (sort (t.ConnectivityList, 2)), sortrows (sort (delaunay (p(:,1), p(:,2)), 2)))
%!assert (t.Points, p)

%!test
%! T = t.ConnectivityList;
%! middle = (p(T(:,1),:) + p(T(:,2),:) + p(T(:,3),:)) / 3;
%! assert (pointLocation (t, middle), (1:rows (T)).');
%! assert (t.pointLocation ([9 9]), NaN);
%! assert (tsearchn (p, T, middle), pointLocation (t, middle));

%!test
%! q = rand (100, 2);
%! [v, d] = nearestNeighbor (t, q);
%! assert (v, dsearchn (p, q));
%! assert (d, norm (p(v,:) - q, 2, "rows"));
%! assert (nearestNeighbors (t, q, 3)(:,1), v);

%!test
%! assert (interpolate (t, p * [2; 3], [.5 .5], "natural"), 2.5, 1e-12);
%! assert (rows (edges (t)), rows (p) + rows (t.ConnectivityList) - 1);
%! assert (sort (unique (freeBoundary (t))), sort (convhull (p(:,1), p(:,2))(1:end-1)));
%! assert (sum (isnan (neighbors (t)(:))), rows (freeBoundary (t)));
%! check (t);

%!test
%! c = delone_triangulation ([0 0; 4 0; 4 4; 0 4; 1 1; 3 1; 3 3; 1 3], [1 2; 2 3; 3 4; 4 1; 5 6; 6 7; 7 8; 8 5]);
%! inside = isInterior (c);
%! assert (rows (c.Constraints), 8);
%! T = c.ConnectivityList(inside,:);
%! a = c.Points(T(:,1),:); b = c.Points(T(:,2),:) - a; d = c.Points(T(:,3),:) - a;
%! assert (sum (b(:,1) .* d(:,2) - b(:,2) .* d(:,1)) / 2, 12);

%!test
%! c = delone_triangulation ([0 0; 1 0; 1 1; 0 1], [1 3; 2 4], "split");
%! assert (c.Points(5,:), [.5 .5]);

%!test
%! s = delone_triangulation (rand (50, 3));
%! assert (columns (s.ConnectivityList), 4);
%! assert (nearestNeighbor (s, s.Points(7,:)), 7);
%! check (s);

## A copy is a value of its own; the triangulation goes with the last of them.
%!test
%! first = delone_triangulation (p);
%! u = first;
%! clear first
%! assert (pointLocation (u, [9 9]), NaN);

%!error <crosses> delone_triangulation ([0 0; 1 0; 1 1; 0 1], [1 3; 2 4])
%!error <row 2 is not finite> delone_triangulation ([0 0; NaN 1])
%!error <plane> delone_triangulation (rand (5, 3), [1 2])
