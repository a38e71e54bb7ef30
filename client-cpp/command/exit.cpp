#include "command/exit.hpp"

namespace rois::command {

Exit exit_of(ReturnCode code) {
    switch (code) {
        case ReturnCode::ok:
            return Exit::ok;
        case ReturnCode::error:
            return Exit::error;
        case ReturnCode::bad_parameter:
            return Exit::bad_parameter;
        case ReturnCode::unsupported:
            return Exit::unsupported;
        case ReturnCode::out_of_resources:
            return Exit::out_of_resources;
        case ReturnCode::timeout:
            return Exit::timeout;
    }
    return Exit::error;
}

Exit exit_of(CompletedStatus status) {
    switch (status) {
        case CompletedStatus::ok:
            return Exit::ok;
        case CompletedStatus::error:
            return Exit::error;
        case CompletedStatus::abort:
            return Exit::aborted;
        case CompletedStatus::out_of_resources:
            return Exit::out_of_resources;
        case CompletedStatus::timeout:
            return Exit::timeout;
    }
    return Exit::error;
}

}  // namespace rois::command
