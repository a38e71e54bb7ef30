#include "xml/validation/content_model.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <xercesc/framework/XMLContentModel.hpp>
#include <xercesc/validators/common/ContentSpecNode.hpp>

#include "xml/codec/names.hpp"
#include "xml/validation/xerces_text.hpp"

namespace rois::xml {

std::string to_text(ElementName const& name) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> prefixes{{
        {rois_namespace, "rois:"},
        {gml_namespace, "gml:"},
        {fes_namespace, "fes:"},
        {unr_namespace, "unr:"},
        {xlink_namespace, "xlink:"},
    }};
    auto const found = std::ranges::find(prefixes, name.name_space, [](auto const& pair) { return pair.first; });
    return found == prefixes.end() ? name.local_name : std::string{found->second} + name.local_name;
}

ContentModel::ContentModel(xercesc::XMLGrammarPool& pool, xercesc::ComplexTypeInfo& type) : pool_{pool}, type_{type} {
    collect(type.getContentSpec());
}

void ContentModel::collect(xercesc::ContentSpecNode* node) {
    // Lists are nested in the second child: iterate over it, and recurse into the first.
    for (; node != nullptr; node = node->getSecond()) {
        if (node->getFirst() != nullptr) collect(node->getFirst());
        auto* const declaration = static_cast<xercesc::SchemaElementDecl*>(node->getElementDecl());
        if (node->getType() != xercesc::ContentSpecNode::Leaf || declaration == nullptr) continue;
        ElementName name{from_xerces(pool_.getURIStringPool()->getValueForId(declaration->getURI())),
                         from_xerces(declaration->getBaseName())};
        if (find(name) == nullptr) declared_.push_back({std::move(name), declaration});
    }
}

xercesc::SchemaElementDecl* ContentModel::find(ElementName const& name) const {
    auto const found = std::ranges::find(declared_, name, &Declared::name);
    return found == declared_.end() ? nullptr : found->declaration;
}

std::unique_ptr<xercesc::QName> ContentModel::make_name(ElementName const& name) const {
    auto const uri = pool_.getURIStringPool()->getId(to_xerces(name.name_space).c_str());
    return std::make_unique<xercesc::QName>(u"", to_xerces(name.local_name).c_str(), uri);
}

ContentModel::Names ContentModel::make_names(std::span<ElementName const> children) const {
    Names names;
    for (auto const& child : children) names.push_back(make_name(child));
    return names;
}

std::optional<std::size_t> ContentModel::failing(Names const& names) const {
    auto* const model = type_.getContentSpec() == nullptr ? nullptr : type_.getContentModel();
    if (model == nullptr) return names.empty() ? std::nullopt : std::optional<std::size_t>{0};
    std::vector<xercesc::QName*> pointers;
    for (auto const& name : names) pointers.push_back(name.get());
    XMLSize_t index = 0;
    auto const no_namespace = pool_.getURIStringPool()->getId(u"");
    if (model->validateContent(pointers.data(), pointers.size(), no_namespace, &index)) return std::nullopt;
    return index;
}

std::optional<std::size_t> ContentModel::failing(std::span<ElementName const> children) const {
    return failing(make_names(children));
}

std::vector<ElementName> ContentModel::expected_after(std::span<ElementName const> children) const {
    constexpr std::size_t most_children = 100;  // each name costs time linear in the children; beyond, returns every name
    std::vector<ElementName> expected;
    auto tried = make_names(children.size() > most_children ? std::span<ElementName const>{} : children);
    tried.emplace_back();
    for (auto const& [name, declaration] : declared_) {
        tried.back() = make_name(name);
        auto const at = failing(tried);
        if (!at || *at == tried.size() || children.size() > most_children) expected.push_back(name);
    }
    return expected;
}

std::vector<ElementName> ContentModel::missing_after(std::span<ElementName const> children) const {
    auto const expected = expected_after(children);
    auto tried = make_names(children);
    tried.emplace_back();
    std::vector<ElementName> completing;
    for (auto const& name : expected) {
        tried.back() = make_name(name);
        if (!failing(tried)) completing.push_back(name);
    }
    return completing.empty() ? expected : completing;
}

}  // namespace rois::xml
