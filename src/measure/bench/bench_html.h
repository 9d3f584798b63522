#pragma once
#include <string>

/// What the pages of all benches share.
namespace bruma::measure {

/// From the doctype to the page's first heading, with the style of text, plots and tables.
std::string page_head(const std::string& title, const std::string& heading);
/// A plot with its title above and what it shows below.
std::string figure(const std::string& title, const std::string& svg, const std::string& finding);

}  // namespace bruma::measure
