#pragma once

#include <cmath>
#include <cstdint>

// A number that counts what is done with it: a method's templates, run on it, give their operation counts.

namespace rtu::model::methods {

/// Operations of binary32 arithmetic. `compare` includes minimum and maximum, `sign` is negation, magnitude,
/// transfer and comparison of sign bits; selections count as nothing.
struct OperationCounts {
    std::uint32_t mul = 0, add = 0, div = 0, compare = 0, sign = 0;
    std::uint32_t fusable = 0;  ///< of the additions: those of a product, so that both can be one operation

    friend bool operator==(const OperationCounts&, const OperationCounts&) = default;
    friend OperationCounts operator+(const OperationCounts& a, const OperationCounts& b) {
        return {a.mul + b.mul,         a.add + b.add,   a.div + b.div,
                a.compare + b.compare, a.sign + b.sign, a.fusable + b.fusable};
    }
};

/// A binary32 number whose operations are counted, in a tally of the thread. Those on a ray's bounds
/// (Counted::bound) are counted apart: they are the caller's share of a test.
class Counted {
  public:
    struct Tally {
        OperationCounts own, interval;
    };
    /// The result of a multiplication, which an addition may fuse with.
    class Product;

    Counted() = default;
    explicit Counted(float value) : value_(value) {}
    explicit Counted(double value) : value_(float(value)) {}
    [[nodiscard]] static Counted bound(float value) {
        Counted counted(value);
        counted.is_bound_ = true;
        return counted;
    }
    [[nodiscard]] float value() const { return value_; }
    explicit operator float() const { return value_; }
    explicit operator double() const { return double(value_); }

    [[nodiscard]] static Tally& tally() {
        thread_local Tally counts;
        return counts;
    }

    friend Product operator*(const Counted& a, const Counted& b);
    friend Counted operator+(const Counted& a, const Counted& b) { return added(a, b, 0); }
    friend Counted operator+(const Product& a, const Counted& b);
    friend Counted operator+(const Counted& a, const Product& b);
    friend Counted operator+(const Product& a, const Product& b);
    friend Counted operator-(const Counted& a, const Counted& b) { return added(a, b.negated(), 0); }
    friend Counted operator-(const Product& a, const Counted& b);
    friend Counted operator-(const Counted& a, const Product& b);
    friend Counted operator-(const Product& a, const Product& b);
    friend Counted operator/(const Counted& a, const Counted& b) {
        ++counts(a, b).div;
        return result(a.value_ / b.value_, a, b);
    }
    friend Counted operator-(const Counted& a) {
        ++counts(a, a).sign;
        return a.negated();
    }
    friend bool operator==(const Counted& a, const Counted& b) { return compared(a, b).value_ == b.value_; }
    friend bool operator<(const Counted& a, const Counted& b) { return compared(a, b).value_ < b.value_; }
    friend bool operator>(const Counted& a, const Counted& b) { return compared(a, b).value_ > b.value_; }
    friend bool operator<=(const Counted& a, const Counted& b) { return compared(a, b).value_ <= b.value_; }
    friend bool operator>=(const Counted& a, const Counted& b) { return compared(a, b).value_ >= b.value_; }

    friend Counted smaller(const Counted& a, const Counted& b) {
        return result(a < b ? a.value_ : b.value_, a, b);
    }
    friend Counted larger(const Counted& a, const Counted& b) {
        return result(a > b ? a.value_ : b.value_, a, b);
    }
    friend Counted select(bool mask, const Counted& yes, const Counted& no) { return mask ? yes : no; }
    friend Counted magnitude(const Counted& a) {
        ++counts(a, a).sign;
        return result(std::abs(a.value_), a, a);
    }
    friend Counted flip_sign(const Counted& a, const Counted& by) {
        ++counts(a, by).sign;
        return std::signbit(by.value_) ? a.negated() : a;
    }
    friend bool has_same_sign(const Counted& a, const Counted& b) {
        ++counts(a, b).sign;
        return std::signbit(a.value_) == std::signbit(b.value_);
    }
    friend bool has_same_sign(const Counted& a, const Counted& b, const Counted& c) {
        const bool first = has_same_sign(a, b), second = has_same_sign(b, c);
        return first && second;
    }

  private:
    float value_ = 0;
    bool is_bound_ = false;

    static OperationCounts& counts(const Counted& a, const Counted& b) {
        return a.is_bound_ || b.is_bound_ ? tally().interval : tally().own;
    }
    static Counted result(float value, const Counted& a, const Counted& b) {
        return a.is_bound_ || b.is_bound_ ? bound(value) : Counted(value);
    }
    static const Counted& compared(const Counted& a, const Counted& b) {
        ++counts(a, b).compare;
        return a;
    }
    static Counted added(const Counted& a, const Counted& b, std::uint32_t fusable) {
        ++counts(a, b).add;
        counts(a, b).fusable += fusable;
        return result(a.value_ + b.value_, a, b);
    }
    [[nodiscard]] Counted negated() const { return result(-value_, *this, *this); }
};

class Counted::Product {
  public:
    explicit Product(const Counted& value) : value_(value) {}
    operator Counted() const { return value_; }  // NOLINT: a product is a number wherever one is asked for
    [[nodiscard]] const Counted& number() const { return value_; }

  private:
    Counted value_;
};

inline Counted::Product operator*(const Counted& a, const Counted& b) {
    ++Counted::counts(a, b).mul;
    return Counted::Product(Counted::result(a.value_ * b.value_, a, b));
}
inline Counted operator+(const Counted::Product& a, const Counted& b) {
    return Counted::added(a.number(), b, 1);
}
inline Counted operator+(const Counted& a, const Counted::Product& b) {
    return Counted::added(a, b.number(), 1);
}
inline Counted operator+(const Counted::Product& a, const Counted::Product& b) {
    return Counted::added(a.number(), b.number(), 1);
}
inline Counted operator-(const Counted::Product& a, const Counted& b) {
    return Counted::added(a.number(), b.negated(), 1);
}
inline Counted operator-(const Counted& a, const Counted::Product& b) {
    return Counted::added(a, b.number().negated(), 1);
}
inline Counted operator-(const Counted::Product& a, const Counted::Product& b) {
    return Counted::added(a.number(), b.number().negated(), 1);
}

}  // namespace rtu::model::methods
