#include <pugixml.hpp>

#include "xml/codec/codec.hpp"
#include "xml/codec/decoding.hpp"
#include "xml/codec/message_tree.hpp"
#include "xml/codec/tree.hpp"
#include "xml/profiles/profile_decoder.hpp"

namespace rois::xml {

namespace {

constexpr std::size_t deepest = 100;             // nested elements; requests have at most 64, answers fewer
constexpr std::size_t keep_at_most = 64 * 1024;  // bytes, between two documents

}  // namespace

class AnswerReader::Impl {
public:
    std::optional<EngineMessage> read(std::string_view document) {
        if (!parse(document)) return std::nullopt;
        auto message = decode_engine_message(message_);
        if (message && !add_profiles(*message, document)) return std::nullopt;
        return message;
    }

    std::optional<StopState> read_stop_state(std::string_view document) {
        return parse(document) ? decode_stop_state(message_) : std::nullopt;
    }

    std::optional<std::vector<EngineState>> read_engines(std::string_view document) {
        return parse(document) ? decode_engines(message_) : std::nullopt;
    }

private:
    // Reads the document into `message_`. Returns false if it is not XML, or nested too deeply.
    bool parse(std::string_view document) {
        tree_.reset();
        if (bytes_.capacity() > keep_at_most) std::string{}.swap(bytes_);
        bytes_ = document;
        auto const parsed = tree_.load_buffer_inplace(bytes_.data(), bytes_.size(), as_xerces_reads, pugi::encoding_utf8);
        return parsed && message_.read(tree_.document_element(), deepest);
    }

    // Adds the profiles of get_profile's reply, in the order of its components. Returns false if one cannot be decoded.
    bool add_profiles(EngineMessage& message, std::string_view document) {
        auto* const answered = std::get_if<Answered>(&message);
        auto* const reply = answered != nullptr ? std::get_if<GetProfile::Reply>(&answered->reply) : nullptr;
        if (reply == nullptr || reply->return_code != ReturnCode::ok) return true;
        try {
            Places places{document};
            auto entry = reply->components.begin();
            for (auto const element : tree_.document_element().children()) {
                auto const name = local_name(element);
                if (name == "HRIEngineProfile") {
                    auto read = decode_profile(element, "get_profile", places).profile;
                    reply->profile = std::make_shared<EngineProfile const>(std::get<EngineProfile>(std::move(read)));
                } else if (name == "HRIComponentProfile" && entry != reply->components.end()) {
                    auto read = decode_profile(element, "get_profile", places).profile;
                    entry++->profile = std::make_shared<ComponentProfile const>(std::get<ComponentProfile>(std::move(read)));
                }
            }
            return reply->profile != nullptr && entry == reply->components.end();
        } catch (BadDocument const&) {
            return false;
        }
    }

    std::string bytes_;
    pugi::xml_document tree_;
    MessageTree message_;
};

AnswerReader::AnswerReader() : impl_{std::make_unique<Impl>()} {}

AnswerReader::~AnswerReader() = default;

AnswerReader::AnswerReader(AnswerReader&&) noexcept = default;

std::optional<EngineMessage> AnswerReader::read(std::string_view document) { return impl_->read(document); }

std::optional<std::vector<EngineState>> AnswerReader::read_engines(std::string_view document) {
    return impl_->read_engines(document);
}

std::optional<StopState> AnswerReader::read_stop_state(std::string_view document) { return impl_->read_stop_state(document); }

}  // namespace rois::xml
