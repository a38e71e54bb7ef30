#include "xml/validation/validator.hpp"

#include <stdexcept>
#include <xercesc/framework/MemBufInputSource.hpp>
#include <xercesc/parsers/SAX2XMLReaderImpl.hpp>
#include <xercesc/sax/ErrorHandler.hpp>
#include <xercesc/sax/SAXParseException.hpp>
#include <xercesc/util/OutOfMemoryException.hpp>
#include <xercesc/util/XMLEntityResolver.hpp>

#include "xml/codec/place.hpp"
#include "xml/validation/grammars.hpp"
#include "xml/validation/parser_memory.hpp"
#include "xml/validation/xerces_text.hpp"

namespace rois::xml {

namespace {

// Rejects every reference to an external entity. Returning an empty source instead would accept it.
class NothingOutside : public xercesc::XMLEntityResolver {
public:
    xercesc::InputSource* resolveEntity(xercesc::XMLResourceIdentifier*) override {
        throw std::runtime_error("the document refers to an external entity, which is not allowed");
    }
};

// Keeps the first error of a parser.
class FirstComplaint : public xercesc::ErrorHandler {
public:
    struct Complaint {
        std::string text;
        Place place;  // the column counts UTF-16 units
    };

    void note(std::string text, Place place = {1, 1}) {
        if (!complaint_) complaint_ = Complaint{std::move(text), place};
    }
    std::optional<Complaint> const& complaint() const { return complaint_; }

private:
    void warning(xercesc::SAXParseException const&) override {}
    void error(xercesc::SAXParseException const& e) override {
        note(from_xerces(e.getMessage()), {e.getLineNumber(), e.getColumnNumber()});
    }
    void fatalError(xercesc::SAXParseException const& e) override { error(e); }
    void resetErrors() override { complaint_.reset(); }

    std::optional<Complaint> complaint_;
};

// A xerces-c parser with hardened settings. Without grammars it checks only that documents are well-formed.
class HardenedParser {
public:
    HardenedParser(xercesc::MemoryManager& memory, xercesc::XMLGrammarPool* grammars)
        : memory_{memory}, parser_{&memory, grammars} {
        bool const validating = grammars != nullptr;
        parser_.setFeature(xercesc::XMLUni::fgSAX2CoreNameSpaces, true);
        parser_.setFeature(xercesc::XMLUni::fgSAX2CoreValidation, validating);
        parser_.setFeature(xercesc::XMLUni::fgXercesDynamic, false);
        parser_.setFeature(xercesc::XMLUni::fgXercesSchema, validating);
        parser_.setFeature(xercesc::XMLUni::fgXercesLoadSchema, false);
        parser_.setFeature(xercesc::XMLUni::fgXercesLoadExternalDTD, false);
        parser_.setFeature(xercesc::XMLUni::fgXercesUseCachedGrammarInParse, validating);
        parser_.setFeature(xercesc::XMLUni::fgXercesDisableDefaultEntityResolution, true);
        parser_.setFeature(xercesc::XMLUni::fgXercesContinueAfterFatalError, false);
        parser_.setFeature(xercesc::XMLUni::fgXercesValidationErrorAsFatal, true);
        auto const* const scanner = validating ? xercesc::XMLUni::fgSGXMLScanner : xercesc::XMLUni::fgWFXMLScanner;
        parser_.setProperty(xercesc::XMLUni::fgXercesScannerName, const_cast<XMLCh*>(scanner));
        parser_.setXMLEntityResolver(&nothing_outside_);
        parser_.setErrorHandler(&first_);
    }

    std::optional<Objection> read(std::string_view document) {
        try {
            xercesc::MemBufInputSource source{reinterpret_cast<XMLByte const*>(document.data()), document.size(), u"document",
                                              false, &memory_};
            source.setCopyBufToStream(false);
            source.setEncoding(xercesc::XMLUni::fgUTF8EncodingString);
            parser_.parse(source);
        } catch (xercesc::OutOfMemoryException const&) {
            first_.note("the document takes too much memory");
        } catch (xercesc::XMLException const& e) {
            first_.note(from_xerces(e.getMessage()));
        } catch (xercesc::SAXException const& e) {
            first_.note(from_xerces(e.getMessage()));
        } catch (std::exception const& e) {
            first_.note(e.what());
        }
        auto const& complaint = first_.complaint();
        if (!complaint) return std::nullopt;
        return Objection{complaint->text, offset_of(document, complaint->place)};
    }

private:
    xercesc::MemoryManager& memory_;
    NothingOutside nothing_outside_;
    FirstComplaint first_;
    xercesc::SAX2XMLReaderImpl parser_;
};

}  // namespace

class Validator::Parser {
public:
    explicit Parser(Schemas const& schemas) : parser_{memory_, &schemas.grammars().pool()}, at_first_{memory_.bytes_in_use()} {}

    std::optional<Objection> read(std::string_view document) { return parser_.read(document); }

    bool is_too_large() const { return memory_.bytes_in_use() > at_first_ + most_in_use || memory_.bytes_kept() > most_kept; }
    std::size_t bytes_in_use() const { return memory_.bytes_in_use(); }

private:
    static constexpr std::size_t most_in_use = 256 << 10;  // bytes, more than a new parser uses
    static constexpr std::size_t most_kept = 2 << 20;      // bytes

    ParserMemory memory_;
    HardenedParser parser_;
    std::size_t at_first_;
};

Validator::Validator(std::shared_ptr<Schemas const> schemas) : schemas_{std::move(schemas)} {}

Validator::~Validator() = default;

std::optional<Objection> Validator::objection_to(std::string_view document) {
    if (!parser_) parser_ = std::make_unique<Parser>(*schemas_);
    auto objection = parser_->read(document);
    if (objection || parser_->is_too_large()) parser_.reset();
    return objection;
}

std::size_t Validator::bytes_in_use() const { return parser_ ? parser_->bytes_in_use() : 0; }

std::optional<Objection> objection_to_form(std::string_view document) {
    ParserMemory memory;
    return HardenedParser{memory, nullptr}.read(document);
}

}  // namespace rois::xml
