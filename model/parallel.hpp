#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_group.h>

namespace rtu::model {

/// Calls body(range) for parts of [0, count), of more than `grain` items where possible, on all cores and in
/// the caller's floating-point mode. By default oneTBB takes the mode in which it was first used, and Embree
/// builds its scenes with denormals flushed to zero: hits would depend on whether Embree was asked first.
template <class Index, class Body, class Partitioner = tbb::auto_partitioner>
void for_each_range(Index count, Index grain, const Body& body, const Partitioner& partitioner = {}) {
    tbb::task_group_context context;
    context.capture_fp_settings();
    tbb::parallel_for(tbb::blocked_range<Index>(0, count, grain), body, partitioner, context);
}

}  // namespace rtu::model
