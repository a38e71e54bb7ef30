// Beside the published headers: a program that proves itself that it is alive (docs/safety.md).
#pragma once

namespace rois::psm {

// A robot that this program has set in motion is held when the program gives no sign of life for the motion lease, 2 s. Each
// function of the C++ PSM is a sign. The notification thread gives signs as well while none of the application's functions hangs
// on it, until `alive` is called for the first time after `connect`. From then on the calls alone count: call it at least every
// 0.4 s in the loop that decides what the robot does. From any thread.
void alive();

}  // namespace rois::psm
