// Points, pairs and faults for delone.hpp, which includes this file.
#ifndef DELONE_POINTS_HPP
#define DELONE_POINTS_HPP

#include "delone.h"

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone {

/// The delone_error of a call, ready to be filled in.
struct fault : delone_error {
    fault() noexcept : delone_error{sizeof(delone_error), DELONE_GOOD, -1, {}} {}
};

class error : public std::runtime_error {
public:
    explicit error(const delone_error &e) : std::runtime_error(e.message), status_(e.status), index_(e.index) {}
    /// DELONE_NOT_FINITE and so on.
    std::int32_t status() const noexcept { return status_; }
    /// The first item that is wrong, or -1.
    std::int64_t index() const noexcept { return index_; }

private:
    std::int32_t status_;
    std::int64_t index_;
};

/// Throws; a program without exceptions ends.
[[noreturn]] inline void fail(const delone_error &e) {
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
    throw error(e);
#else
    static_cast<void>(e);
    std::abort();
#endif
}

[[noreturn]] inline void fail(std::int32_t status, std::int64_t index, const char *message) {
    fault f;
    f.status = status;
    f.index = index;
    std::strncpy(f.message, message, sizeof f.message - 1);
    fail(f);
}

inline void raise(std::int32_t status, const delone_error &e) {
    if (status != DELONE_GOOD) fail(e);
}

inline void raise(std::int32_t status) {
    if (status != DELONE_GOOD) fail(status, -1, delone_status_name(status));
}

inline void check_index(std::size_t i, std::size_t count) {
    if (i >= count) fail(DELONE_INDEX, static_cast<std::int64_t>(i), "the index is out of range");
}

/// The numbers of a vector of arrays, one after the other.
template <class T, std::size_t N> T *numbers(std::vector<std::array<T, N>> &rows) noexcept {
    return rows.empty() ? nullptr : rows[0].data();
}

/// Items that are elsewhere, as std::span is in C++20.
template <class T> class view {
public:
    using value_type = T;
    view() noexcept = default;
    view(const T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <class R, class = std::enable_if_t<std::is_convertible_v<decltype(std::data(std::declval<const R &>())), const T *>>>
    view(const R &range) noexcept : data_(std::data(range)), size_(std::size(range)) {}

    const T *data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }
    const T *begin() const noexcept { return data_; }
    const T *end() const noexcept { return data_ + size_; }
    const T &operator[](std::size_t i) const noexcept { return data_[i]; }

private:
    const T *data_ = nullptr;
    std::size_t size_ = 0;
};

namespace detail {

/// Converts to one type alone, so that braces tell what members are.
template <class N> struct exactly {
    template <class U, class = std::enable_if_t<std::is_same_v<U, N>>> operator U() const noexcept;
};

template <class, class T, class... A> struct takes_braces : std::false_type {};
template <class T, class... A> struct takes_braces<std::void_t<decltype(T{std::declval<A>()...})>, T, A...> : std::true_type {};

template <class T, class N, std::size_t D> constexpr bool has_members() {
    using X = exactly<N>;
    if constexpr (std::is_array_v<T>) {
        return std::is_same_v<std::remove_cv_t<std::remove_extent_t<T>>, N> && std::extent_v<T> >= D;
    } else if constexpr (!std::is_aggregate_v<T>) {
        return false;
    } else if constexpr (D == 2) {
        return takes_braces<void, T, X, X>::value;
    } else {
        return takes_braces<void, T, X, X, X>::value;
    }
}

template <class T, class N> constexpr bool is_number = std::is_same_v<std::remove_cv_t<std::remove_reference_t<T>>, N>;

template <class T, class N, class = void> constexpr bool has_x = false;
template <class T, class N> constexpr bool has_x<T, N, std::void_t<decltype(std::declval<const T &>().x)>> =
    is_number<decltype(std::declval<const T &>().x), N>;
template <class T, class N, class = void> constexpr bool calls_x = false;
template <class T, class N> constexpr bool calls_x<T, N, std::void_t<decltype(std::declval<const T &>().x())>> =
    is_number<decltype(std::declval<const T &>().x()), N>;
template <class T, class N, class = void> constexpr bool has_rows = false;
template <class T, class N> constexpr bool has_rows<T, N, std::void_t<decltype(std::declval<const T &>()[0])>> =
    is_number<decltype(std::declval<const T &>()[0]), N>;

/// Matrices of Eigen, of either order, their blocks and maps: a row a point.
template <class M, class = void> constexpr bool is_matrix = false;
template <class M> constexpr bool is_matrix<M, std::void_t<decltype(std::declval<const M &>().rowStride(), std::declval<const M &>().colStride(),
                                                                    std::declval<const M &>().data())>> = true;

template <class T, class N> constexpr bool is_pair = std::is_same_v<T, std::pair<N, N>> || std::is_same_v<T, std::complex<N>>;

} // namespace detail

/// Whether a type begins with D numbers N, as far as its members tell. Specialise it for a type of yours that does, and does not show it.
template <class T, class N, std::size_t D>
struct begins_with
    : std::bool_constant<(sizeof(T) >= D * sizeof(N)) && std::is_standard_layout_v<T> &&
                         (detail::has_members<T, N, D>() || (D == 2 && detail::is_pair<T, N>) ||
                          (!std::is_aggregate_v<T> && (detail::has_x<T, N> || detail::calls_x<T, N> || detail::has_rows<T, N>)))> {};

/// Points of a caller: where they are, and from one to the next so many bytes. They must outlive it.
template <std::size_t D> class points_in {
    template <class R> using element = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(std::declval<const R &>()))>>;
    template <class R, class N> static constexpr bool fits = begins_with<element<R>, N, D>::value;

public:
    /// A contiguous range whose elements begin with D numbers, all double or all float.
    template <class R, class E = element<R>, class = std::enable_if_t<(fits<R, double> || fits<R, float>) && !detail::is_matrix<R>>>
    points_in(const R &range) noexcept {
        using N = std::conditional_t<fits<R, double>, double, float>;
        set(reinterpret_cast<const N *>(std::data(range)), std::size(range), sizeof(E));
    }
    /// A matrix of Eigen with D columns.
    template <class M, std::enable_if_t<detail::is_matrix<M>, int> = 0> points_in(const M &matrix) {
        if (static_cast<std::size_t>(matrix.cols()) != D) fail(DELONE_ARGUMENT, -1, "a matrix with a column for each coordinate is needed");
        const auto *x = matrix.data();
        auto stride = static_cast<std::size_t>(matrix.rowStride()) * sizeof *x;
        set(x, x + matrix.colStride(), D == 3 ? x + 2 * matrix.colStride() : nullptr, static_cast<std::size_t>(matrix.rows()), stride);
    }
    /// Pointers to the first coordinates, how many points there are, and from one to the next so many bytes.
    template <class N, std::size_t P = D, class = std::enable_if_t<P == 2 && (std::is_same_v<N, double> || std::is_same_v<N, float>)>>
    points_in(const N *x, const N *y, std::size_t count, std::size_t stride = sizeof(N)) noexcept {
        set(x, y, static_cast<const N *>(nullptr), count, stride);
    }
    template <class N, std::size_t P = D, class = std::enable_if_t<P == 3 && (std::is_same_v<N, double> || std::is_same_v<N, float>)>>
    points_in(const N *x, const N *y, const N *z, std::size_t count, std::size_t stride = sizeof(N)) noexcept {
        set(x, y, z, count, stride);
    }
    std::size_t size() const noexcept { return raw_.count; }
    const delone_points *raw() const noexcept { return &raw_; }

private:
    template <class N> void set(const N *first, std::size_t count, std::size_t stride) noexcept {
        const N *z = nullptr;
        if constexpr (D == 3) z = first == nullptr ? nullptr : first + 2;
        set(first, first == nullptr ? nullptr : first + 1, z, count, stride);
    }
    template <class N> void set(const N *x, const N *y, const N *z, std::size_t count, std::size_t stride) noexcept {
        constexpr std::int32_t type = std::is_same_v<N, double> ? DELONE_DOUBLE : DELONE_FLOAT;
        // An empty range may have no memory; in space a missing z would be the plane.
        static constexpr N nowhere[3] = {};
        if (count == 0) x = nowhere, y = nowhere + 1, z = D == 3 ? nowhere + 2 : nullptr;
        raw_ = delone_points{sizeof(delone_points), type, count, stride, x, y, z};
    }
    delone_points raw_;
};

using points2 = points_in<2>;
using points3 = points_in<3>;

namespace detail {
template <std::size_t D, class R> auto flat(const R &range) {
    using N = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(range))>>;
    static_assert(std::is_same_v<N, double> || std::is_same_v<N, float>, "a range of double or float");
    if (std::size(range) % D != 0) fail(DELONE_ARGUMENT, -1, "the number of coordinates is no multiple of the dimension");
    using row = std::array<N, D>;
    return points_in<D>(view<row>(reinterpret_cast<const row *>(std::data(range)), std::size(range) / D));
}
} // namespace detail

/// Points of a range of numbers: x, y, x, y.
template <class R> points2 xy(const R &range) { return detail::flat<2>(range); }
/// Points of a range of numbers: x, y, z, x, y, z.
template <class R> points3 xyz(const R &range) { return detail::flat<3>(range); }

/// Segments, copied from any range of pairs of integers.
class pairs {
public:
    pairs() = default;
    template <class R, class = decltype(std::begin(std::declval<const R &>()))> pairs(const R &range) {
        for (const auto &item : range) {
            const auto &[a, b] = item;
            add(a, b);
        }
    }
    pairs(std::initializer_list<std::array<std::uint32_t, 2>> range) {
        for (const auto &item : range) add(item[0], item[1]);
    }
    std::size_t size() const noexcept { return ends_.size(); }
    const std::uint32_t *data() const noexcept { return ends_.empty() ? nullptr : ends_[0].data(); }

private:
    template <class I> void add(I a, I b) {
        static_assert(std::is_integral_v<I>, "segments are pairs of integers");
        ends_.push_back({index(a), index(b)});
    }
    template <class I> std::uint32_t index(I i) const {
        bool is_negative = false;
        if constexpr (std::is_signed_v<I>) is_negative = i < 0;
        if (is_negative || static_cast<std::uint64_t>(i) > std::numeric_limits<std::uint32_t>::max()) {
            fail(DELONE_INDEX, static_cast<std::int64_t>(ends_.size()), "an index of a segment is out of range");
        }
        return static_cast<std::uint32_t>(i);
    }
    std::vector<std::array<std::uint32_t, 2>> ends_;
};

} // namespace delone

#endif
