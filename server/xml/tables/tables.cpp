#include "xml/tables/tables.hpp"

#include <algorithm>

#include "xml/codec/names.hpp"
#include "xml/tables/tables_builder.hpp"

namespace rois::xml {

Tables::Tables(xercesc::XMLGrammarPool& pool, std::vector<std::string> const& namespaces) {
    for (auto const& each : namespaces) {
        // Documents rarely declare the xml namespace: xerces-c decides about those that do. The empty namespace cannot be
        // declared.
        if (each != xml_namespace && !each.empty()) last_name_space_ = std::max(last_name_space_, names_.add(each));
    }
    xsi_type_ = {names_.find(xsi_namespace), names_.add("type")};
    TablesBuilder{*this}.build(pool);
}

Interned::Id Tables::name_space(std::string_view text) const {
    auto const found = names_.find(text);
    return found > Interned::empty && found <= last_name_space_ ? found : Interned::unknown;
}

ElementDeclaration const* Tables::root(Name wanted) const {
    auto const found = std::ranges::find(roots_, wanted, &std::pair<Name, ElementDeclaration const*>::first);
    return found == roots_.end() ? nullptr : found->second;
}

}  // namespace rois::xml
