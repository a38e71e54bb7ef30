#include "main/logging.hpp"

#include <fcntl.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>

namespace rois {

namespace {

// %* in a pattern: the message as a JSON string.
class JsonText : public spdlog::custom_flag_formatter {
public:
    void format(spdlog::details::log_msg const& message, std::tm const&, spdlog::memory_buf_t& out) override {
        std::string const text{message.payload.data(), message.payload.size()};
        auto const json = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        out.append(json.data(), json.data() + json.size());
    }

    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<JsonText>(); }
};

spdlog::level::level_enum level_of(LogLevel level) {
    switch (level) {
        case LogLevel::debug:
            return spdlog::level::debug;
        case LogLevel::info:
            return spdlog::level::info;
        case LogLevel::warning:
            return spdlog::level::warn;
        case LogLevel::error:
            break;
    }
    return spdlog::level::err;
}

}  // namespace

void protect_standard_files() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);  // writing beyond the limit of a file then fails
    for (int file = STDIN_FILENO; file <= STDERR_FILENO; ++file)
        if (::fcntl(file, F_GETFD) < 0)  // takes the lowest free number, which is `file`
            ::open("/dev/null", file == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

std::shared_ptr<LogQueue const> set_up_logging(LogFormat format, LogLevel level) {
    auto queue = std::make_shared<LogQueue>(STDERR_FILENO);
    auto logger = std::make_shared<spdlog::logger>("rois-gateway", queue);
    auto formatter = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
    formatter->add_flag<JsonText>('*');
    formatter->set_pattern(format == LogFormat::json ? R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l","message":%*})"
                                                     : "%Y-%m-%dT%H:%M:%S.%eZ %^%l%$ %v");
    logger->set_formatter(std::move(formatter));
    logger->set_level(level_of(level));
    spdlog::set_default_logger(std::move(logger));
    return queue;
}

LogFlush::~LogFlush() { spdlog::default_logger_raw()->flush(); }

}  // namespace rois
