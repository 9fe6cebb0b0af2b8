#include "study/precision_operations.hpp"

#include <map>
#include <string>

#include "model/error.hpp"
#include "model/methods/single_call-inl.hpp"

namespace rtu::study {
namespace {

namespace methods = model::methods::RTU_TARGET;

thread_local TestOperations counted;

struct Counting {
    float value = 0;
    Counting() = default;
    explicit Counting(float v) : value(v) {}
    explicit Counting(double v) : value(static_cast<float>(v)) {}
    friend Counting operator+(Counting a, Counting b) { return done(counted.add, a.value + b.value); }
    friend Counting operator-(Counting a, Counting b) { return done(counted.add, a.value - b.value); }
    friend Counting operator*(Counting a, Counting b) { return done(counted.mul, a.value * b.value); }
    friend Counting operator/(Counting a, Counting b) { return done(counted.div, a.value / b.value); }
    friend Counting operator-(Counting a) { return Counting(-a.value); }
    friend bool operator<(Counting a, Counting b) { return a.value < b.value; }
    friend bool operator>(Counting a, Counting b) { return a.value > b.value; }
    friend bool operator<=(Counting a, Counting b) { return a.value <= b.value; }
    friend bool operator>=(Counting a, Counting b) { return a.value >= b.value; }
    friend bool operator==(Counting a, Counting b) { return a.value == b.value; }
    explicit operator double() const { return double(value); }
    friend Counting smaller(Counting a, Counting b) { return a < b ? a : b; }
    friend Counting larger(Counting a, Counting b) { return a > b ? a : b; }
    friend Counting select(bool mask, Counting yes, Counting no) { return mask ? yes : no; }
    friend Counting magnitude(Counting a) { return Counting(methods::magnitude(a.value)); }
    friend Counting flip_sign(Counting a, Counting by) {
        return Counting(methods::flip_sign(a.value, by.value));
    }
    friend bool has_same_sign(Counting a, Counting b) { return methods::has_same_sign(a.value, b.value); }

  private:
    static Counting done(double& count, float value) {
        count += 1;
        return Counting(value);
    }
};

using Vector = methods::Vector<Counting>;

Vector vector(float x, float y, float z) { return {{Counting(x), Counting(y), Counting(z)}}; }

// A triangle hit from its front, in its middle.
template <class M>
TestOperations counted_test() {
    using model::methods::AxisOwner;
    const Vector a = vector(-1, -1, 0.1F), b = vector(1, -1, 0.2F), c = vector(0, 1, 0.3F);
    const Vector origin = vector(0.1F, 0.2F, 3), direction = vector(0.01F, 0.02F, -1);
    const methods::Axis of_ray = axis_of_ray(M::info, direction),
                        of_triangle = axis_of_triangle(M::info, a, b, c);
    const auto kept = M::prepare(origin, direction, of_ray);
    const auto stored = M::store(a, b, c, of_triangle);
    const methods::Interval<Counting> interval{Counting(0.0F), Counting(9.0F)};
    counted = {};
    const auto candidate =
        M::test(kept, interval, stored, M::info.axis_owner == AxisOwner::Ray ? of_ray : of_triangle);
    RTU_CHECK(candidate.is_hit, "{} misses", M::info.name);
    static_cast<void>(M::finish(candidate));
    return counted;
}

// Two triangles of which the ray hits the one on its front and the other on its back: a folded pair.
template <class M>
void add_pair(std::vector<PairOperations>& all) {
    if constexpr (requires { M::has_pair; }) {
        if constexpr (M::has_pair) {
            using model::methods::AxisOwner;
            const Vector a = vector(-1, -1, 0.1F), b = vector(1, -1, 0.2F), c = vector(0, 1, 0.3F),
                         d = vector(1, -0.9F, 0.25F);
            const Vector origin = vector(0.1F, 0.2F, 3), direction = vector(0.01F, 0.02F, -1);
            const methods::Axis axis = axis_of_ray(M::info, direction);
            const auto kept = M::prepare(origin, direction, axis);
            const auto stored = M::store_pair(a, b, c, d, axis);
            const methods::Interval<Counting> interval{Counting(0.0F), Counting(9.0F)};
            counted = {};
            const auto candidates = M::test_pair(kept, interval, stored, axis);
            RTU_CHECK(candidates.first.is_hit && candidates.second.is_hit, "{} misses", M::info.name);
            static_cast<void>(M::finish(candidates.first));
            static_cast<void>(M::finish(candidates.second));
            const TestOperations pair = counted, one = counted_test<M>();
            all.push_back({std::string(M::info.name),
                           std::string(M::info.title),
                           one,
                           {2 * one.mul, 2 * one.add, 2 * one.div},
                           pair});
        }
    }
}

template <class... Methods>
std::vector<PairOperations> all_pairs(methods::MethodList<Methods...>) {
    std::vector<PairOperations> all;
    (add_pair<Methods>(all), ...);
    return all;
}

template <class... Methods>
std::map<std::string, TestOperations, std::less<>> all_counts(methods::MethodList<Methods...>) {
    return {{std::string(Methods::info.name), counted_test<Methods>()}...};
}

}  // namespace

TestOperations operations_of(std::string_view method) {
    static const auto counts = all_counts(methods::AllMethods());
    const auto found = counts.find(method);
    RTU_CHECK(found != counts.end(), "no method {}", method);
    return found->second;
}

std::vector<PairOperations> pair_operations() { return all_pairs(methods::AllMethods()); }

}  // namespace rtu::study
