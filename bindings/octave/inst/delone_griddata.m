## delone_griddata: values between points.
##
## VQ = delone_griddata (X, Y, V, XQ, YQ)
## VQ = delone_griddata (X, Y, V, XQ, YQ, METHOD)
## VQ = delone_griddata (X, Y, Z, V, XQ, YQ, ZQ, METHOD)
##
## As `griddata`. METHOD is "linear" (the default), "nearest", "natural" (natural neighbors, Sibson) or "laplace"; in space "linear" and
## "nearest" are sure. Outside of the hull VQ is NaN. A row XQ and a column YQ span a grid.
##
## Example:
##
##   x = rand (1, 500); y = rand (1, 500);
##   [XQ, YQ] = meshgrid (linspace (0, 1, 50));
##   surf (XQ, YQ, delone_griddata (x, y, sin (6 * x) .* y, XQ, YQ, "natural"));
##
## See also: griddata, delone_triangulation.

function VQ = delone_griddata (varargin)
  how = "linear";
  if (nargin > 0 && ischar (varargin{end}))
    how = varargin{end};
    varargin(end) = [];
  endif
  if (! any (numel (varargin) == [5, 7]))
    print_usage ();
  endif
  dimension = (numel (varargin) - 1) / 2;
  number = find (strcmp (how, {"linear", "nearest", "laplace", "natural"}));
  if (isempty (number))
    error ("delone_griddata: METHOD \"%s\" is unknown: linear, nearest, natural, laplace", how);
  endif
  columns = @(items) cell2mat (cellfun (@(x) x(:), items, "UniformOutput", false));
  places = varargin(dimension + 2:end);
  if (dimension == 2 && isrow (places{1}) && iscolumn (places{2}) && ! isscalar (places{1}) && ! isscalar (places{2}))
    [places{:}] = meshgrid (places{:});
  endif
  if (! size_equal (places{:}) || any (cellfun (@numel, varargin(1:dimension)) != numel (varargin{dimension + 1})))
    error ("delone_griddata: coordinates and values have different numbers of elements");
  endif
  t = __delone__ ("new", columns (varargin(1:dimension)));
  VQ = reshape (__delone__ ("interpolate", t, varargin{dimension + 1}, columns (places), number - 1), size (places{1}));
endfunction

%!shared x, y, v, xq, yq
%! x = [0 1 0 1 .5 .3]; y = [0 0 1 1 .4 .8]; v = 2 * x - 3 * y + 1;
%! [xq, yq] = meshgrid (.1:.2:.9);
%!assert (delone_griddata (x, y, v, xq, yq), 2 * xq - 3 * yq + 1, 1e-12)
%!assert (delone_griddata (x, y, v, xq, yq, "natural"), 2 * xq - 3 * yq + 1, 1e-12)
%!assert (delone_griddata (x, y, v, xq, yq, "laplace"), 2 * xq - 3 * yq + 1, 1e-12)
%!assert (delone_griddata (x, y, v, .1:.2:.9, (.1:.2:.9).'), 2 * xq - 3 * yq + 1, 1e-12)
%!assert (delone_griddata (x, y, v, .31, .8, "nearest"), v(6))
%!assert (delone_griddata (x, y, v, 5, 5), NaN)

## The values are those of griddata, where the triangles are.
%!test
%! rand ("seed", 3);
%! x = rand (200, 1); y = rand (200, 1); v = sin (5 * x) .* y;
%! [xq, yq] = meshgrid (.2:.05:.8);
%! assert (delone_griddata (x, y, v, xq, yq), griddata (x, y, v, xq, yq), 1e-12);

%!test
%! p = rand (50, 3); v = p * [1; 2; 3];
%! assert (delone_griddata (p(:,1), p(:,2), p(:,3), v, .5, .5, .5), 3, 1e-12);

%!error <unknown> delone_griddata (x, y, v, xq, yq, "cubic")
%!error <different numbers> delone_griddata (x, y, 1, xq, yq)
