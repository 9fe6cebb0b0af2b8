#include "study/version.hpp"

namespace rtu::study {

std::string_view version() { return RTUSIM_VERSION; }

}  // namespace rtu::study
