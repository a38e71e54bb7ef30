#include "types/identifier_length.hpp"
#include "xml/codec/codec.hpp"
#include "xml/codec/decoding.hpp"
#include "xml/validation/checked_reader.hpp"
#include "xml/validation/explanation.hpp"

namespace rois::xml {

class RequestReader::Impl {
public:
    Impl(std::shared_ptr<Schemas const> schemas, DocumentLimits limits, Validation validation)
        : schemas_{schemas},
          limits_{limits},
          validation_{validation},
          reader_{std::move(schemas), limits, operation_names(), ForeignNamespaces::refused, validation} {}

    bool uses(DocumentLimits const& limits, Validation validation) const {
        return limits == limits_ && validation == validation_;
    }
    std::shared_ptr<Schemas const> const& schemas() const { return schemas_; }

    std::variant<Request, Fault> read(std::string_view document) {
        if (auto fault = reader_.read(document)) return *std::move(fault);
        if (auto request = decode(reader_.message())) {
            if (auto problem = why_too_long("request_id", request->request_id))
                return reader_.complain(reader_.root(), *std::move(problem));
            return *std::move(request);
        }
        // The document is valid, but it is an answer, a notification or a profile.
        auto const explanation = explain(*schemas_, reader_.root(), operation_names());
        return reader_.complain(reader_.root(), explanation ? explanation->reason : "the message is not a request");
    }

    std::optional<Validation> checked() const { return reader_.checked(); }

private:
    std::shared_ptr<Schemas const> schemas_;
    DocumentLimits limits_;
    Validation validation_;
    CheckedReader reader_;
};

RequestReader::RequestReader(std::shared_ptr<Schemas const> schemas, DocumentLimits limits, Validation validation)
    : impl_{std::make_unique<Impl>(std::move(schemas), limits, validation)} {}

RequestReader::~RequestReader() = default;

RequestReader::RequestReader(RequestReader&&) noexcept = default;

RequestReader& RequestReader::use(DocumentLimits const& limits, Validation validation) {
    if (!impl_->uses(limits, validation)) impl_ = std::make_unique<Impl>(impl_->schemas(), limits, validation);
    return *this;
}

std::variant<Request, Fault> RequestReader::read(std::string_view document) { return impl_->read(document); }

std::optional<Validation> RequestReader::checked() const { return impl_->checked(); }

}  // namespace rois::xml
