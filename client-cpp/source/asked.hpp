// What the comfortable layer asks: replies that are OK, or Error.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core.hpp"

namespace rois::detail {

// `what` must live as long as the program. Error says it, and about whom.
template <class Op>
Task<typename Op::Reply> asked(std::shared_ptr<Core> core, Op operation, std::string_view what, std::string whom = {}) {
    Request request{std::move(operation), {}};
    auto answer = co_await core->request(std::move(request), core->settings().deadline);
    auto reply = reply_of<Op>(std::move(answer));
    if (reply.return_code != ReturnCode::ok) throw Error{reply.return_code, std::string{what} + whom + ": " + reply.reason};
    co_return std::move(reply);
}

}  // namespace rois::detail
