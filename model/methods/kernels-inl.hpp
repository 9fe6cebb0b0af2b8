// The loops of kernel.hpp over any method, at Real = float (W = 1) or Lanes<W>.

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <type_traits>
#include <vector>

#include "model/methods/kernel.hpp"
#include "model/methods/methods-inl.hpp"
#include "model/methods/single_call-inl.hpp"

#if defined(RTU_KERNELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RTU_KERNELS_INL
#undef RTU_KERNELS_INL
#else
#define RTU_KERNELS_INL
#endif

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

template <class Real>
inline constexpr std::size_t width_of = sizeof(Real) / sizeof(float);

/// How many Reals a struct of nothing else has.
template <class Fields>
inline constexpr std::size_t field_count = sizeof(Fields) / sizeof(float);

// One Real for each number at `from`: W of each field in a row, or one for all lanes.
template <class Real>
[[nodiscard]] HWY_INLINE Real load_real(const float* from) {
    if constexpr (std::is_same_v<Real, float>)
        return *from;
    else
        return Real::load(from);
}

template <class Fields, class Real>
[[nodiscard]] HWY_INLINE Fields load_fields(const float* from) {
    std::array<Real, sizeof(Fields) / sizeof(Real)> fields;
    for (std::size_t i = 0; i < fields.size(); ++i) fields[i] = load_real<Real>(from + i * width_of<Real>);
    return std::bit_cast<Fields>(fields);
}

template <class Fields, class Real>
[[nodiscard]] HWY_INLINE Fields broadcast_fields(const float* from) {
    std::array<Real, sizeof(Fields) / sizeof(Real)> fields;
    for (std::size_t i = 0; i < fields.size(); ++i) fields[i] = Real(from[i]);
    return std::bit_cast<Fields>(fields);
}

/// 0, 1, ..., W - 1.
template <class Real>
[[nodiscard]] HWY_INLINE Real lane_numbers() {
    if constexpr (std::is_same_v<Real, float>)
        return 0.0F;
    else
        return Real(hn::Iota(LanesTag<width_of<Real>>(), 0.0F));
}

template <class Real>
HWY_INLINE void store_real(Real value, float* to) {
    if constexpr (std::is_same_v<Real, float>)
        *to = value;
    else
        value.store(to);
}

/// The nearest hit so far and the number of hits, in each lane.
template <class Real>
class Nearest {
  public:
    // A constructor that the compiler writes is not compiled for the instruction set.
    HWY_INLINE Nearest()
        : t_(std::numeric_limits<float>::infinity()), u_(0.0F), v_(0.0F), triangle_(0.0F), count_(0.0F) {}

    HWY_INLINE void add(MaskOf<Real> is_hit, const Distances<Real>& hit, Real triangle) {
        count_ = count_ + select(is_hit, Real(1.0F), Real(0.0F));
        const auto is_nearer = both(is_hit, hit.t < t_);
        t_ = select(is_nearer, hit.t, t_);
        u_ = select(is_nearer, hit.u, u_);
        v_ = select(is_nearer, hit.v, v_);
        triangle_ = select(is_nearer, triangle, triangle_);
    }
    [[nodiscard]] HWY_INLINE Real t() const { return t_; }
    /// The least t of all lanes.
    [[nodiscard]] HWY_INLINE Real least_t() const {
        if constexpr (std::is_same_v<Real, float>)
            return t_;
        else
            return Real(hn::MinOfLanes(LanesTag<width_of<Real>>(), t_.v));
    }
    [[nodiscard]] std::array<RayResult, width_of<Real>> lanes() const {
        constexpr std::size_t width = width_of<Real>;
        alignas(64) std::array<std::array<float, std::max<std::size_t>(width, 4)>, 5> values;
        const std::array<Real, 5> reals{t_, u_, v_, triangle_, count_};
        for (std::size_t i = 0; i < 5; ++i) store_real(reals[i], values[i].data());
        std::array<RayResult, width> results;
        for (std::size_t i = 0; i < width; ++i)
            if (values[4][i] > 0)
                results[i] = {{values[0][i], values[1][i], values[2][i]},
                              std::uint32_t(values[3][i]),
                              std::uint32_t(values[4][i])};
        return results;
    }

  private:
    Real t_, u_, v_, triangle_, count_;
};

/// Lanes of one ray put together.
template <std::size_t W>
[[nodiscard]] RayResult reduced(const std::array<RayResult, W>& lanes) {
    RayResult result = lanes[0];
    std::uint32_t hits = 0;
    for (const RayResult& lane : lanes) {
        hits += lane.hit_count;
        if (lane.hit_count == 0) continue;
        const bool is_nearer = result.hit_count == 0 || lane.nearest.t < result.nearest.t ||
                               (lane.nearest.t == result.nearest.t && lane.triangle < result.triangle);
        if (is_nearer) result = lane;
    }
    result.hit_count = hits;
    return result;
}

// Blocks of W triangles or pairs, a block's fields one after the other, then its axes if it has any. The last
// block is filled up with copies of the last triangle.
template <class Fields, std::size_t W, bool HasAxes>
struct Blocks {
    static constexpr std::size_t size = (field_count<Fields> + (HasAxes ? 1 : 0)) * W;
    static HWY_INLINE void set(float* blocks, std::size_t index, const Fields& fields, Axis axis) {
        const auto values = std::bit_cast<std::array<float, field_count<Fields>>>(fields);
        float* lane = blocks + index / W * size + index % W;
        for (std::size_t i = 0; i < values.size(); ++i) lane[i * W] = values[i];
        if constexpr (HasAxes) lane[values.size() * W] = float(axis.index);
    }
};

[[nodiscard]] inline std::size_t round_up(std::size_t count, std::size_t to) {
    return (count + to - 1) / to * to;
}

template <class M>
inline constexpr bool has_triangle_axis = M::info.axis_owner == AxisOwner::Triangle;

template <class M, std::size_t W>
void store_triangles(std::span<const Corners> triangles, PreparedTriangles& to) {
    using Fields = typename M::template Stored<float>;
    using Layout = Blocks<Fields, W, has_triangle_axis<M> && (W > 1)>;
    const std::size_t filled = round_up(triangles.size(), W);
    float* values = to.reserve(filled / W * Layout::size);
    to.count = triangles.size();
    if (W == 1) to.axes.resize(has_triangle_axis<M> ? filled : 0);
    for (std::size_t i = 0; i < filled; ++i) {
        const Corners& corners = triangles[std::min(i, triangles.size() - 1)];
        const auto a = vector_of(corners[0]), b = vector_of(corners[1]), c = vector_of(corners[2]);
        const Axis axis = axis_of_triangle(M::info, a, b, c);
        Layout::set(values, i, M::store(a, b, c, axis), axis);
        if (W == 1 && has_triangle_axis<M>) to.axes[i] = std::uint8_t(axis.index);
    }
}

template <class M, std::size_t W>
void store_pairs(std::span<const Corners> triangles, PreparedTriangles& to) {
    using Fields = typename M::template PairStored<float>;
    using Layout = Blocks<Fields, W, false>;
    const std::size_t count = triangles.size() / 2, filled = round_up(count, W);
    float* values = to.reserve(filled / W * Layout::size);
    to.count = count;
    for (std::size_t i = 0; i < filled; ++i) {
        const Corners &first = triangles[2 * std::min(i, count - 1)],
                      &second = triangles[2 * std::min(i, count - 1) + 1];
        Layout::set(values, i,
                    M::store_pair(vector_of(first[0]), vector_of(first[1]), vector_of(first[2]),
                                  vector_of(second[2]), Axis{}),
                    Axis{});
    }
}

/// Calls `body` with the ray's axis as a constant, where the method has one.
template <class M, class Body>
HWY_INLINE void with_ray_axis(Axis axis, Body body) {
    if constexpr (M::info.axis_owner == AxisOwner::Ray) {
        if (axis.index == 0)
            body(StaticAxis<0>());
        else if (axis.index == 1)
            body(StaticAxis<1>());
        else
            body(StaticAxis<2>());
    } else {
        body(axis);
    }
}

template <class M, class Real, class RayAxis>
[[nodiscard]] HWY_INLINE auto axis_of_block(const PreparedTriangles& triangles, const float* axes,
                                            std::size_t block, RayAxis ray_axis) {
    if constexpr (!has_triangle_axis<M>)
        return ray_axis;
    else if constexpr (std::is_same_v<Real, float>)
        return Axis{triangles.axes[block]};
    else
        return LaneAxis<width_of<Real>>::load(axes);
}

/// The lanes of a block that hold a triangle of their own.
template <class Real>
[[nodiscard]] HWY_INLINE MaskOf<Real> lanes_below(std::size_t count) {
    return lane_numbers<Real>() < Real(float(count));
}

template <class M, class Real, class RayAxis>
[[nodiscard]] HWY_INLINE RayResult trace_ray_triangles(const PreparedTriangles& triangles, const Ray& ray,
                                                       const typename M::template RayData<Real>& data,
                                                       RayAxis ray_axis, bool shrinks) {
    constexpr std::size_t width = width_of<Real>;
    using Stored = typename M::template Stored<Real>;
    constexpr std::size_t fields = sizeof(Stored) / sizeof(Real);
    constexpr std::size_t block_size = Blocks < typename M::template Stored<float>, width,
                          has_triangle_axis<M> && (width > 1) > ::size;
    Nearest<Real> nearest;
    Interval<Real> interval{Real(ray.t_min), Real(ray.t_max)};
    const float* block = triangles.values.get();
    for (std::size_t first = 0; first < triangles.count; first += width, block += block_size) {
        const auto axis = axis_of_block<M, Real>(triangles, block + fields * width, first, ray_axis);
        const auto candidate = M::test(data, interval, load_fields<Stored, Real>(block), axis);
        if (is_none(candidate.is_hit)) continue;
        const auto is_hit = both(candidate.is_hit, lanes_below<Real>(triangles.count - first));
        nearest.add(is_hit, M::finish(candidate), Real(float(first)) + lane_numbers<Real>());
        if (shrinks) interval.t_max = select(nearest.t() < interval.t_max, nearest.least_t(), interval.t_max);
    }
    return reduced(nearest.lanes());
}

template <class M, class Real, class RayAxis>
[[nodiscard]] HWY_INLINE RayResult trace_ray_pairs(const PreparedTriangles& pairs, const Ray& ray,
                                                   const typename M::template RayData<Real>& data,
                                                   RayAxis ray_axis, bool shrinks) {
    constexpr std::size_t width = width_of<Real>;
    using Stored = typename M::template PairStored<Real>;
    Nearest<Real> nearest;
    Interval<Real> interval{Real(ray.t_min), Real(ray.t_max)};
    const float* block = pairs.values.get();
    for (std::size_t first = 0; first < pairs.count;
         first += width, block += sizeof(Stored) / sizeof(float)) {
        const auto found = M::test_pair(data, interval, load_fields<Stored, Real>(block), ray_axis);
        if (is_none(either(found.first.is_hit, found.second.is_hit))) continue;
        const auto is_own = lanes_below<Real>(pairs.count - first);
        const Real pair = Real(float(first)) + lane_numbers<Real>();
        const Real triangle = pair + pair;
        nearest.add(both(found.first.is_hit, is_own), M::finish(found.first), triangle);
        nearest.add(both(found.second.is_hit, is_own), M::finish(found.second), triangle + Real(1.0F));
        if (shrinks) interval.t_max = select(nearest.t() < interval.t_max, nearest.least_t(), interval.t_max);
    }
    return reduced(nearest.lanes());
}

template <class M>
[[nodiscard]] auto prepared_ray(const Ray& ray, Axis axis) {
    return M::prepare(vector_of(ray.origin), vector_of(ray.direction), axis);
}

/// Form Single, Triangles or Pairs.
template <class M, class Real, bool IsPair>
void trace_each_ray(const PreparedTriangles& triangles, std::span<const Ray> rays, bool shrinks,
                    std::span<RayResult> results) {
    using Kept = typename M::template RayData<float>;
    using Data = typename M::template RayData<Real>;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Axis ray_axis = axis_of_ray(M::info, vector_of(rays[i].direction));
        const auto kept =
            std::bit_cast<std::array<float, field_count<Kept>>>(prepared_ray<M>(rays[i], ray_axis));
        const Data data = broadcast_fields<Data, Real>(kept.data());
        with_ray_axis<M>(ray_axis, [&](auto axis) HWY_ATTR {
            if constexpr (IsPair)
                results[i] = trace_ray_pairs<M, Real>(triangles, rays[i], data, axis, shrinks);
            else
                results[i] = trace_ray_triangles<M, Real>(triangles, rays[i], data, axis, shrinks);
        });
    }
}

/// W rays, each in its lane, as the method keeps them.
template <class M, std::size_t W>
class Packet {
  public:
    using Real = Lanes<W>;
    using Data = typename M::template RayData<Real>;

    /// The last ray fills up a packet of fewer than W.
    explicit Packet(std::span<const Ray> rays) {
        for (std::size_t lane = 0; lane < W; ++lane) {
            const Ray& ray = rays[std::min(lane, rays.size() - 1)];
            const Axis axis = axis_of_ray(M::info, vector_of(ray.direction));
            const auto kept = std::bit_cast<std::array<float, fields>>(prepared_ray<M>(ray, axis));
            for (std::size_t i = 0; i < fields; ++i) values_[i * W + lane] = kept[i];
            values_[fields * W + lane] = ray.t_min;
            values_[(fields + 1) * W + lane] = ray.t_max;
            values_[(fields + 2) * W + lane] = float(axis.index);
        }
    }
    [[nodiscard]] Data data() const { return load_fields<Data, Real>(values_.data()); }
    [[nodiscard]] Interval<Real> interval() const {
        return {Real::load(&values_[fields * W]), Real::load(&values_[(fields + 1) * W])};
    }
    [[nodiscard]] LaneAxis<W> axis() const { return LaneAxis<W>::load(&values_[(fields + 2) * W]); }

  private:
    static constexpr std::size_t fields = field_count<typename M::template RayData<float>>;
    alignas(64) std::array<float, (fields + 3) * W> values_;
};

template <class M, class RayAxis>
[[nodiscard]] HWY_INLINE auto axis_of_single(const PreparedTriangles& triangles, std::size_t i,
                                             RayAxis ray_axis) {
    if constexpr (has_triangle_axis<M>)
        return Axis{triangles.axes[i]};
    else if constexpr (M::info.axis_owner == AxisOwner::Ray)
        return ray_axis;
    else
        return Axis{};
}

/// Form Rays.
template <class M, std::size_t W>
void trace_packets(const PreparedTriangles& triangles, std::span<const Ray> rays, bool shrinks,
                   std::span<RayResult> results) {
    using Real = Lanes<W>;
    using Stored = typename M::template Stored<Real>;
    constexpr std::size_t fields = sizeof(Stored) / sizeof(Real);
    for (std::size_t first = 0; first < rays.size(); first += W) {
        const Packet<M, W> packet(rays.subspan(first, std::min(W, rays.size() - first)));
        const auto data = packet.data();
        const auto ray_axis = packet.axis();
        Interval<Real> interval = packet.interval();
        Nearest<Real> nearest;
        const float* stored = triangles.values.get();
        for (std::size_t i = 0; i < triangles.count; ++i, stored += fields) {
            const auto candidate = M::test(data, interval, broadcast_fields<Stored, Real>(stored),
                                           axis_of_single<M>(triangles, i, ray_axis));
            if (is_none(candidate.is_hit)) continue;
            nearest.add(candidate.is_hit, M::finish(candidate), Real(float(i)));
            if (shrinks) interval.t_max = select(nearest.t() < interval.t_max, nearest.t(), interval.t_max);
        }
        const auto lanes = nearest.lanes();
        std::copy_n(lanes.begin(), std::min(W, rays.size() - first), results.begin() + std::ptrdiff_t(first));
    }
}

template <class M>
concept HasPair = M::has_pair;

template <class M, std::size_t W>
void add_wide(std::vector<Kernel>& kernels) {
    if constexpr (W <= most_lanes) {
        kernels.push_back({M::info, Form::Rays, W, &store_triangles<M, 1>, &trace_packets<M, W>});
        kernels.push_back(
            {M::info, Form::Triangles, W, &store_triangles<M, W>, &trace_each_ray<M, Lanes<W>, false>});
        if constexpr (HasPair<M>)
            kernels.push_back(
                {M::info, Form::Pairs, W, &store_pairs<M, W>, &trace_each_ray<M, Lanes<W>, true>});
    }
}

template <class M>
void add_kernels(std::vector<Kernel>& kernels) {
    kernels.push_back({M::info, Form::Single, 1, &store_triangles<M, 1>, &trace_each_ray<M, float, false>});
    if constexpr (HasPair<M>)
        kernels.push_back({M::info, Form::Pairs, 1, &store_pairs<M, 1>, &trace_each_ray<M, float, true>});
    add_wide<M, 4>(kernels);
    add_wide<M, 8>(kernels);
    add_wide<M, 16>(kernels);
}

template <class... Methods>
void add_all_kernels(MethodList<Methods...>, std::vector<Kernel>& kernels) {
    (add_kernels<Methods>(kernels), ...);
}

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();

#endif
