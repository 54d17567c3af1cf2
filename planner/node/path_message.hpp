#pragma once

#include "floornav/path_t.hpp"
#include "planner/plan.hpp"

namespace floornav {

/// Status, reason, points, length and the map that a plan rests on. Not for PlanStatus::kInterrupted, which
/// says nothing of the way: throws std::logic_error.
path_t to_message(const Plan& plan);

}  // namespace floornav
