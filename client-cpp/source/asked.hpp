// Requests of the public classes: an OK reply, or an Error.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core.hpp"

namespace rois::detail {

// Sends an operation and returns its reply. Throws Error unless the return code is OK; its text begins with `what` and `whom`.
// `what` must have static lifetime.
template <class Op>
Task<typename Op::Reply> asked(std::shared_ptr<Core> core, Op operation, std::string_view what, std::string whom = {}) {
    Request request{std::move(operation), {}};
    auto answer = co_await core->request(std::move(request), core->settings().deadline);
    auto reply = reply_of<Op>(std::move(answer));
    if (reply.return_code != ReturnCode::ok) throw Error{reply.return_code, std::string{what} + whom + ": " + reply.reason};
    co_return std::move(reply);
}

}  // namespace rois::detail
