#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

/// Plots as SVG text that stands in a page by itself: no script, no font and no style from elsewhere. Colours are the
/// page's variables --ink, --grid and --series-0 to --series-5 (see plot_style), so they follow light and dark.
namespace bruma::measure {

/// One line of a log-log plot; points with a coordinate that is not above 0 are left out.
struct PlotLine {
    std::string name;
    std::vector<glm::dvec2> points;
    bool dashed = false;  ///< fitted and not measured, or the second line of a colour
    int series = 0;       ///< colour and marker
};
struct LogLogPlot {
    std::string x_label, y_label;
    std::vector<PlotLine> lines;
};
std::string svg_of(const LogLogPlot& plot);

/// Horizontal bars on one linear axis from 0.
struct Bar {
    std::string name;
    double value = 0.0;
    int series = 0;
    std::string remark = {};  ///< behind the number
};
struct BarPlot {
    std::string x_label;
    std::vector<Bar> bars;
};
std::string svg_of(const BarPlot& plot);

/// CSS of the variables and classes that the plots use. Series colours are those of Okabe and Ito (Color Universal
/// Design, 2008), which people with any kind of colour vision tell apart; markers differ too.
std::string plot_style();

/// &, < and > as HTML wants them.
std::string html_text(const std::string& text);

}  // namespace bruma::measure
