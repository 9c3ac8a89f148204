// Velocities at the start that contradict what holds a body, what comes after them, or what they are to meet.
#pragma once

#include <string>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// Sections [[initial]] that give a velocity to nodes that a support holds in its direction, part by part; those that
/// later sections overwrite altogether; a velocity along gravity beside a drop height, which are added; falls that meet
/// nothing (no obstacle, stop or other part stands ahead of what falls); heights of more than 50 m that are more than a
/// hundred times the size of the body, as 1000 is where metres are meant and millimetres were written.
std::vector<std::string> start_warnings(const Simulation& simulation);

}  // namespace carom
