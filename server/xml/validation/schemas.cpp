#include "xml/validation/schemas.hpp"

#include <algorithm>
#include <mutex>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>
#include <xercesc/framework/MemBufInputSource.hpp>
#include <xercesc/framework/XMLGrammarPoolImpl.hpp>
#include <xercesc/parsers/SAX2XMLReaderImpl.hpp>
#include <xercesc/sax/ErrorHandler.hpp>
#include <xercesc/sax/SAXParseException.hpp>
#include <xercesc/util/OutOfMemoryException.hpp>
#include <xercesc/util/PlatformUtils.hpp>
#include <xercesc/util/XMLEntityResolver.hpp>
#include <xercesc/util/XMLResourceIdentifier.hpp>
#include <xercesc/validators/datatype/DatatypeValidatorFactory.hpp>
#include <xercesc/validators/schema/SchemaGrammar.hpp>

#include "types/text/texts.hpp"
#include "xml/codec/names.hpp"
#include "xml/validation/grammars.hpp"
#include "xml/validation/xerces_text.hpp"

namespace rois::xml {

namespace {

std::mutex platform_mutex;  // xerces-c's reference count is not thread-safe

// Resolves schema locations to the given files only.
class GivenFiles : public xercesc::XMLEntityResolver {
public:
    explicit GivenFiles(NamedFiles const& files) : files_{files} {}

    xercesc::InputSource* resolveEntity(xercesc::XMLResourceIdentifier* wanted) override {
        return source(from_xerces(wanted->getSchemaLocation() != nullptr ? wanted->getSchemaLocation() : wanted->getSystemId()))
            .release();
    }

    std::unique_ptr<xercesc::InputSource> source(std::string const& name) {
        auto const file = files_.find(name);
        if (file == files_.end()) throw std::runtime_error("the schema " + quoted(name) + " is not among the given files");
        read_.insert(name);
        auto made = std::make_unique<xercesc::MemBufInputSource>(reinterpret_cast<XMLByte const*>(file->second.data()),
                                                                 file->second.size(), to_xerces(name).c_str());
        made->setCopyBufToStream(false);
        return made;
    }

    bool has_read(std::string const& name) const { return read_.contains(name); }

private:
    NamedFiles const& files_;
    std::set<std::string> read_;
};

// Throws at the first error, with its place, or with only the name of the current file if the parser reports no place.
class Complaints : public xercesc::ErrorHandler {
public:
    void compiling(std::string name) { name_ = std::move(name); }

    void warning(xercesc::SAXParseException const& e) override { error(e); }
    void fatalError(xercesc::SAXParseException const& e) override { error(e); }
    void error(xercesc::SAXParseException const& e) override {
        auto const message = from_xerces(e.getMessage());
        if (e.getLineNumber() == 0) throw std::runtime_error(name_ + ": " + message);
        throw std::runtime_error(from_xerces(e.getSystemId()) + ":" + std::to_string(e.getLineNumber()) + ":" +
                                 std::to_string(e.getColumnNumber()) + ": " + message);
    }
    void resetErrors() override {}

private:
    std::string name_;
};

// Returns the names of the files that other files include or import.
std::set<std::string> referenced(NamedFiles const& files) {
    std::set<std::string> names;
    for (auto const& [name, text] : files) {
        pugi::xml_document tree;
        tree.load_buffer(text.data(), text.size());
        for (auto const child : tree.document_element().children()) {
            if (auto const location = child.attribute("schemaLocation")) names.insert(location.value());
        }
    }
    return names;
}

void compile(NamedFiles const& files, xercesc::XMLGrammarPool& pool) {
    GivenFiles given{files};
    Complaints complaints;
    xercesc::SAX2XMLReaderImpl reader{xercesc::XMLPlatformUtils::fgMemoryManager, &pool};
    reader.setFeature(xercesc::XMLUni::fgSAX2CoreValidation, true);
    reader.setFeature(xercesc::XMLUni::fgXercesDynamic, false);
    reader.setFeature(xercesc::XMLUni::fgXercesSchema, true);
    reader.setFeature(xercesc::XMLUni::fgXercesSchemaFullChecking, true);
    reader.setFeature(xercesc::XMLUni::fgXercesDisableDefaultEntityResolution, true);
    reader.setFeature(xercesc::XMLUni::fgXercesUseCachedGrammarInParse, true);
    reader.setXMLEntityResolver(&given);
    reader.setErrorHandler(&complaints);

    auto const inner = referenced(files);
    auto const load = [&](std::string const& name) {
        if (given.has_read(name)) return;
        auto const source = given.source(name);
        complaints.compiling(name);
        if (reader.loadGrammar(*source, xercesc::Grammar::SchemaGrammarType, true) == nullptr) {
            throw std::runtime_error(name + ": the schema cannot be compiled, and xerces-c gave no reason");
        }
    };
    // Loads the files that no other file refers to; they load the others. Then loads files that refer to each other in a circle.
    for (auto const& [name, text] : files) {
        if (!inner.contains(name)) load(name);
    }
    for (auto const& [name, text] : files) load(name);
}

// xerces-c builds some parts of a grammar at their first use, without a lock. Builds them here, before threads share it.
void warm_up(xercesc::SchemaGrammar& grammar) {
    if (auto* const types = grammar.getComplexTypeRegistry()) {
        xercesc::RefHashTableOfEnumerator<xercesc::ComplexTypeInfo> all{types};
        while (all.hasMoreElements()) {
            auto& type = all.nextElement();
            type.getAttDefList();
            if (type.getContentSpec() != nullptr) type.getContentModel();
        }
    }
    auto* const simple = grammar.getDatatypeRegistry()->getUserDefinedRegistry();
    if (simple == nullptr) return;
    xercesc::RefHashTableOfEnumerator<xercesc::DatatypeValidator> all{simple};
    while (all.hasMoreElements()) {
        try {
            all.nextElement().validate(u"0", nullptr, xercesc::XMLPlatformUtils::fgMemoryManager);
        } catch (xercesc::XMLException const&) {
            continue;  // not a value of this type
        }
    }
}

}  // namespace

Platform::Platform() {
    std::lock_guard const lock{platform_mutex};
    ::setenv("XERCES_DISABLE_DTD", "1", 1);
    xercesc::XMLPlatformUtils::Initialize();
}

Platform::~Platform() {
    std::lock_guard const lock{platform_mutex};
    xercesc::XMLPlatformUtils::Terminate();
}

Schemas::Grammars::Grammars(NamedFiles const& files)
    : pool_{std::make_unique<xercesc::XMLGrammarPoolImpl>(xercesc::XMLPlatformUtils::fgMemoryManager)} {
    compile(files, *pool_);
    for (auto all = pool_->getGrammarEnumerator(); all.hasMoreElements();) {
        auto& grammar = static_cast<xercesc::SchemaGrammar&>(all.nextElement());
        warm_up(grammar);
        namespaces_.push_back(from_xerces(grammar.getTargetNamespace()));
    }
    for (auto const known : {xsd_namespace, xsi_namespace, xml_namespace, xlink_namespace}) {
        if (std::ranges::find(namespaces_, known) == namespaces_.end()) namespaces_.emplace_back(known);
    }
    pool_->lockPool();
    tables_ = std::make_unique<Tables const>(*pool_, namespaces_);
}

Schemas::Schemas(NamedFiles files) : files_{std::move(files)} {
    try {
        grammars_ = std::make_unique<Grammars>(files_);
    } catch (xercesc::XMLException const& e) {
        throw std::runtime_error("schemas: " + from_xerces(e.getMessage()));
    } catch (xercesc::OutOfMemoryException const&) {
        throw std::runtime_error("schemas: out of memory");
    }
}

Schemas::~Schemas() = default;

}  // namespace rois::xml
