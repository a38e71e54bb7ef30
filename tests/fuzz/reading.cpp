#include "fuzz/reading.hpp"

#include <pugixml.hpp>
#include <set>
#include <string_view>
#include <xercesc/framework/MemBufInputSource.hpp>
#include <xercesc/parsers/SAX2XMLReaderImpl.hpp>
#include <xercesc/sax2/Attributes.hpp>
#include <xercesc/sax2/DefaultHandler.hpp>

#include "xml/codec/names.hpp"
#include "xml/codec/tree.hpp"
#include "xml/validation/xerces_text.hpp"

namespace rois::fuzz {

namespace {

std::string expanded(std::string_view name_space, std::string_view local) {
    return std::string{"{"}.append(name_space).append("}").append(local);
}

std::string start_of(std::string const& name, std::set<std::string> const& attributes) {
    auto text = "<" + name;
    for (auto const& attribute : attributes) text += " " + attribute;
    return text + ">";
}

class Writer : public xercesc::DefaultHandler {
public:
    std::string written;

private:
    void startElement(XMLCh const* uri, XMLCh const* local, XMLCh const*, xercesc::Attributes const& all) override {
        std::set<std::string> attributes;
        for (XMLSize_t i = 0; i < all.getLength(); ++i) {
            auto const name = expanded(xml::from_xerces(all.getURI(i)), xml::from_xerces(all.getLocalName(i)));
            if (!xml::declares_namespace(xml::from_xerces(all.getQName(i))))
                attributes.insert(name + "=" + xml::from_xerces(all.getValue(i)));
        }
        written += start_of(expanded(xml::from_xerces(uri), xml::from_xerces(local)), attributes);
    }
    void endElement(XMLCh const*, XMLCh const*, XMLCh const*) override { written += "</>"; }
    void characters(XMLCh const* text, XMLSize_t length) override {
        written += xml::from_xerces(std::u16string{text, text + length}.c_str());
    }
    void ignorableWhitespace(XMLCh const* text, XMLSize_t length) override { characters(text, length); }
};

void write(std::string& written, pugi::xml_node node) {
    if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
        written += node.value();
        return;
    }
    if (node.type() != pugi::node_element) return;
    auto const name_of = [&](std::string_view full, bool attribute) {
        auto const prefix = xml::prefix_of(full);
        auto const name_space = attribute && prefix.empty() ? std::string_view{} : xml::namespace_of(node, prefix);
        return expanded(name_space, xml::local_part(full));
    };
    std::set<std::string> attributes;
    for (auto const attribute : node.attributes()) {
        if (!xml::declares_namespace(attribute.name()))
            attributes.insert(name_of(attribute.name(), true) + "=" + attribute.value());
    }
    written += start_of(name_of(node.name(), false), attributes);
    for (auto const child : node.children()) write(written, child);
    written += "</>";
}

}  // namespace

std::string read_by_xerces(std::string const& document) {
    Writer writer;
    xercesc::SAX2XMLReaderImpl parser;
    parser.setFeature(xercesc::XMLUni::fgSAX2CoreNameSpaces, true);
    parser.setFeature(xercesc::XMLUni::fgSAX2CoreValidation, false);
    parser.setContentHandler(&writer);
    xercesc::MemBufInputSource source{reinterpret_cast<XMLByte const*>(document.data()), document.size(), "document"};
    source.setEncoding(xercesc::XMLUni::fgUTF8EncodingString);
    parser.parse(source);
    return writer.written;
}

std::string read_by_pugixml(std::string document) {
    pugi::xml_document tree;
    if (auto const result = tree.load_buffer_inplace(document.data(), document.size(), xml::as_xerces_reads, pugi::encoding_utf8);
        !result) {
        return result.description();
    }
    std::string written;
    for (auto const child : tree.children()) write(written, child);
    return written;
}

}  // namespace rois::fuzz
