#pragma once

#include "model/error.hpp"
#include "study/chart/chart.hpp"

namespace rtu::study {

constexpr const char* no_gnuplot = "no gnuplot here: install gnuplot-nox";

inline bool has_gnuplot() {
    try {
        check_gnuplot();
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace rtu::study
