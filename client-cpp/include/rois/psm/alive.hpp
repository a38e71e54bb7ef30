// An addition to the published headers: signs of life from the program itself (docs/safety.md).
#pragma once

namespace rois::psm {

// Gives a sign of life. A robot that this program has set in motion is halted if the program gives none for the motion lease,
// 2 s. Each call of a function of the C++ PSM is a sign. Until the first call of `alive` after `connect`, the notification thread
// gives signs, too, while no function of the application blocks it. After that only calls count: call `alive` at least every
// 0.4 s in the loop that controls the robot. From any thread.
void alive();

}  // namespace rois::psm
