#include "measure/bench/plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace bruma::measure {
namespace {

constexpr double width = 560.0, height = 360.0;
constexpr double left = 66.0, right = 16.0, top = 12.0, bottom = 48.0;

/// Maps the logarithms of [low, high] to pixels.
struct LogAxis {
    double low = 1.0, high = 10.0;
    double from = 0.0, to = 1.0;  ///< pixels

    double at(double value) const {
        return from + (to - from) * (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
    }
    /// Whole decades, with 2 and 5 in between where there are few.
    std::vector<double> ticks() const {
        std::vector<double> result;
        const double decades = std::log10(high / low);
        for (int e = int(std::floor(std::log10(low))); e <= int(std::ceil(std::log10(high))); ++e) {
            for (const double m : {1.0, 2.0, 5.0}) {
                const double value = m * std::pow(10.0, e);
                if ((m == 1.0 || decades <= 2.6) && value >= low * 0.999 && value <= high * 1.001) {
                    result.push_back(value);
                }
            }
        }
        return result;
    }
};

std::string tick_text(double value) {
    if (value >= 1e-3 && value < 1e5) {
        return fmt::format("{:g}", value);
    }
    const int exponent = int(std::floor(std::log10(value) + 1e-9));
    const double m = value / std::pow(10.0, exponent);
    const std::string power = fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{}</tspan>", exponent);
    return std::abs(m - 1.0) < 1e-6 ? power : fmt::format("{:g}\u00b7{}", m, power);
}

bool is_shown(glm::dvec2 p) {
    return p.x > 0.0 && p.y > 0.0 && std::isfinite(p.x) && std::isfinite(p.y);
}

std::string marker(glm::dvec2 p, int series) {
    switch (series % 4) {
        case 0:
            return fmt::format("<circle class=\"f{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>", series, p.x, p.y);
        case 1:
            return fmt::format("<rect class=\"f{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"7\" height=\"7\"/>", series,
                               p.x - 3.5, p.y - 3.5);
        case 2:
            return fmt::format("<path class=\"f{}\" d=\"M{:.1f} {:.1f}l4.5 8h-9z\"/>", series, p.x, p.y - 5.0);
        default:
            return fmt::format("<path class=\"f{}\" d=\"M{:.1f} {:.1f}l5 5l-5 5l-5 -5z\"/>", series, p.x, p.y - 5.0);
    }
}

std::string open_svg(double h, const std::string& says) {
    return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width, h, html_text(says));
}

/// The ends of the data with some room, so that no marker sits on the frame.
void fit(LogAxis& axis, double low, double high) {
    const double room = std::pow(std::max(high / low, 1.5), 0.06);
    axis.low = low / room;
    axis.high = high * room;
}

std::string frame_and_ticks(const LogAxis& x, const LogAxis& y) {
    std::string text;
    for (const double value : x.ticks()) {
        text += fmt::format(
            "<path class=\"g\" d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\" "
            "text-anchor=\"middle\">{4}</text>\n",
            x.at(value), top, height - bottom, height - bottom + 18.0, tick_text(value));
    }
    for (const double value : y.ticks()) {
        text += fmt::format(
            "<path class=\"g\" d=\"M{1} {0:.1f}H{2}\"/><text x=\"{3}\" y=\"{4:.1f}\" "
            "text-anchor=\"end\">{5}</text>\n",
            y.at(value), left, width - right, left - 7.0, y.at(value) + 4.0, tick_text(value));
    }
    return text + fmt::format("<rect class=\"b\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", left, top,
                              width - left - right, height - top - bottom);
}

/// Names beside samples of their lines, in the corner that holds the fewest points.
std::string legend(const std::vector<PlotLine>& lines, const LogAxis& x, const LogAxis& y) {
    constexpr double row = 18.0;
    std::size_t longest = 0;
    for (const PlotLine& line : lines) {
        longest = std::max(longest, line.name.size());
    }
    const double w = 44.0 + 6.6 * double(longest);
    const double h = row * double(lines.size()) + 8.0;
    glm::dvec2 best(0.0);
    int fewest = 1 << 30;
    for (const glm::dvec2 corner :
         {glm::dvec2(width - right - w - 6.0, height - bottom - h - 6.0), glm::dvec2(left + 6.0, top + 6.0),
          glm::dvec2(width - right - w - 6.0, top + 6.0), glm::dvec2(left + 6.0, height - bottom - h - 6.0)}) {
        int inside = 0;
        for (const PlotLine& line : lines) {
            for (std::size_t n = 0; n + 1 < line.points.size(); ++n) {
                for (int part = 0; part <= 8 && is_shown(line.points[n]) && is_shown(line.points[n + 1]); ++part) {
                    const glm::dvec2 a(x.at(line.points[n].x), y.at(line.points[n].y));
                    const glm::dvec2 b(x.at(line.points[n + 1].x), y.at(line.points[n + 1].y));
                    const glm::dvec2 p = glm::mix(a, b, part / 8.0) - corner;
                    inside += p.x > -6.0 && p.x < w + 6.0 && p.y > -6.0 && p.y < h + 6.0 ? 1 : 0;
                }
            }
        }
        if (inside < fewest) {
            fewest = inside;
            best = corner;
        }
    }
    std::string text = fmt::format("<rect class=\"l\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>",
                                   best.x, best.y, w, h);
    double at = best.y + 4.0 + 0.5 * row;
    for (const PlotLine& line : lines) {
        text += fmt::format("<path class=\"s{}{}\" d=\"M{:.1f} {:.1f}h24\"/>", line.series, line.dashed ? " d" : "",
                            best.x + 8.0, at);
        text += line.dashed ? "" : marker({best.x + 20.0, at}, line.series);
        text +=
            fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", best.x + 38.0, at + 4.0, html_text(line.name));
        at += row;
    }
    return text;
}

}  // namespace

std::string html_text(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string svg_of(const LogLogPlot& plot) {
    glm::dvec2 low(1e300), high(0.0);
    for (const PlotLine& line : plot.lines) {
        for (const glm::dvec2 p : line.points) {
            if (is_shown(p)) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
    }
    std::string text = open_svg(height, plot.y_label + " against " + plot.x_label);
    if (!(high.x > 0.0)) {
        return text + "<text x=\"20\" y=\"30\">nothing above 0 was measured</text></svg>\n";
    }
    LogAxis x{1.0, 10.0, left, width - right};
    LogAxis y{1.0, 10.0, height - bottom, top};
    fit(x, low.x, high.x);
    fit(y, low.y, high.y);
    text += frame_and_ticks(x, y);
    for (const PlotLine& line : plot.lines) {
        std::string path;
        std::string markers;
        for (const glm::dvec2 p : line.points) {
            if (is_shown(p)) {
                const glm::dvec2 at(x.at(p.x), y.at(p.y));
                path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", at.x, at.y);
                markers += line.dashed ? "" : marker(at, line.series);
            }
        }
        if (!path.empty()) {
            text += fmt::format("<path class=\"s{}{}\" d=\"{}\"/>{}\n", line.series, line.dashed ? " d" : "", path,
                                markers);
        }
    }
    text += legend(plot.lines, x, y);
    text += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", 0.5 * (left + width - right),
                        height - 10.0, html_text(plot.x_label));
    text += fmt::format("<text transform=\"translate(15 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                        0.5 * (top + height - bottom), html_text(plot.y_label));
    return text + "</svg>\n";
}

std::string svg_of(const BarPlot& plot) {
    constexpr double row = 26.0, names = 205.0, numbers = 104.0;
    double most = 0.0;
    for (const Bar& bar : plot.bars) {
        most = std::max(most, bar.value);
    }
    most = most > 0.0 ? most : 1.0;
    const double h = row * double(plot.bars.size()) + 40.0;
    std::string text = open_svg(h, plot.x_label);
    double at = 8.0;
    for (const Bar& bar : plot.bars) {
        const double length = (width - names - numbers) * bar.value / most;
        text += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", names - 8.0, at + 15.0,
                            html_text(bar.name));
        text += fmt::format("<rect class=\"f{}\" x=\"{}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\"/>", bar.series,
                            names, at + 2.0, length, row - 8.0);
        text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{:.3g}{}</text>\n", names + length + 6.0, at + 15.0,
                            bar.value, html_text(bar.remark));
        at += row;
    }
    text += fmt::format("<path class=\"b\" d=\"M{} 4V{:.1f}\"/>", names, at + 2.0);
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                        0.5 * (names + width - numbers), at + 22.0, html_text(plot.x_label));
    return text + "</svg>\n";
}

std::string plot_style() {
    std::string text = R"(:root{color-scheme:light dark;--paper:#fdfdfc;--ink:#1c1e21;--soft:#5a6067;--grid:#e2e4e7;
--series-0:#0072B2;--series-1:#D55E00;--series-2:#007a59;--series-3:#a8487f;--series-4:#8a6d00;--series-5:#6b6f74}
@media (prefers-color-scheme:dark){:root{--paper:#16181b;--ink:#e8e9eb;--soft:#a4abb3;--grid:#32363b;
--series-0:#56B4E9;--series-1:#E69F00;--series-2:#2fc79c;--series-3:#e39ac4;--series-4:#F0E442;--series-5:#9aa0a6}}
svg{width:100%;height:auto;display:block}
svg text{fill:var(--ink);font:12px system-ui,sans-serif}
svg .g{stroke:var(--grid);fill:none}svg .b{stroke:var(--soft);fill:none}
svg .l{fill:var(--paper);fill-opacity:.85;stroke:var(--grid)}
svg .d{stroke-dasharray:5 5;stroke-width:1.2}
)";
    for (int n = 0; n < 6; ++n) {
        text += fmt::format(
            "svg .s{0}{{stroke:var(--series-{0});fill:none;stroke-width:2}}svg .f{0}{{fill:var(--series-{0})}}\n", n);
    }
    // After the series, so that it wins over their width.
    return text + "svg .d{stroke-width:1.3}\n";
}

}  // namespace bruma::measure
