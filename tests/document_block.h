// Parts of a page of docs/ that tests write: what stands between <!-- begin NAME --> and <!-- end NAME -->.
#pragma once

#include <optional>
#include <string>

namespace etd {

// Whether expected texts are to be rewritten (ETENDUE_UPDATE_EXPECTED is set).
bool updates_expected();
// The block without its marks; nothing when the page has none of this name.
std::optional<std::string> read_document_block(const std::string& page, const std::string& name);
// Puts `text` between the marks, which must be there.
void write_document_block(const std::string& page, const std::string& name, const std::string& text);

}  // namespace etd
