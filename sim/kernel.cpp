#include "sim/kernel.hpp"

#include <systemc>
#include <vector>

namespace rtu::sim {

void start_fresh_kernel() {
    // A used context cannot be destroyed safely. All stay reachable, so that leak checkers know them as kept.
    static auto& contexts = *new std::vector<sc_core::sc_simcontext*>;
    contexts.push_back(new sc_core::sc_simcontext);
    sc_core::sc_curr_simcontext = contexts.back();
    sc_core::sc_default_global_context = sc_core::sc_curr_simcontext;
}

}  // namespace rtu::sim
