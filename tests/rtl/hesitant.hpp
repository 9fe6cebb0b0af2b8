#pragma once

#include "vectors.hpp"

namespace rtu::test {

/// Two sides of a unit, each unwilling at random for runs of cycles: see rtl::run_stream.
class Hesitant {
  public:
    bool offers() { return toss(is_offering_); }
    bool takes() { return toss(is_taking_); }

  private:
    bool toss(bool& state) {
        if (random_.one_in(5)) state = !state;
        return state;
    }
    RandomBits random_{3};
    bool is_offering_ = false, is_taking_ = false;
};

}  // namespace rtu::test
