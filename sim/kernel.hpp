#pragma once

namespace rtu::sim {

/// Starts a new SystemC simulation in this process: the library knows one elaboration a context, so a second
/// machine needs a second context. All modules of the last one must be gone. The old context is not freed (a
/// few kilobytes).
void start_fresh_kernel();

}  // namespace rtu::sim
