#include "measure/bench/bench_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <regex>

#include "io/atomic_file.h"
#include "io/json/json_text.h"
#include "measure/bench/plot.h"

namespace bruma::measure {
namespace {

bool is_plain(const std::string& word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
    });
}

std::string csv_cell(const nlohmann::json& cell) {
    if (cell.is_string()) {
        const auto word = cell.get<std::string>();
        return is_plain(word) ? word : fmt::format("\"{}\"", std::regex_replace(word, std::regex("\""), "\"\""));
    }
    if (cell.is_boolean()) {
        return cell.get<bool>() ? "1" : "0";
    }
    return cell.is_number_float() ? fmt::format("{:.6g}", cell.get<double>()) : io::report_text(cell, -1);
}

std::string html_cell(const nlohmann::json& cell, const std::string& format) {
    if (cell.is_string()) {
        return html_text(cell.get<std::string>());
    }
    if (cell.is_boolean()) {
        return cell.get<bool>() ? "yes" : "no";
    }
    if (cell.is_number_float()) {
        return fmt::format(fmt::runtime(format.empty() ? "{:g}" : format), cell.get<double>());
    }
    return io::report_text(cell, -1);
}

}  // namespace

BenchTable stacked(const std::string& key, const std::vector<std::pair<std::string, BenchTable>>& tables) {
    BenchTable all;
    for (const auto& [name, table] : tables) {
        if (all.keys.empty()) {
            all = table;
            all.rows.clear();
            all.keys.insert(all.keys.begin(), key);
            all.headings.insert(all.headings.begin(), key);
            all.formats.insert(all.formats.begin(), "");
        }
        for (std::vector<nlohmann::json> row : table.rows) {
            row.insert(row.begin(), name);
            all.rows.push_back(std::move(row));
        }
    }
    return all;
}

std::string csv_of(const BenchTable& table) {
    std::string text = fmt::format("{}\n", fmt::join(table.keys, ","));
    for (const auto& row : table.rows) {
        std::vector<std::string> cells;
        std::transform(row.begin(), row.end(), std::back_inserter(cells), csv_cell);
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

nlohmann::json json_of(const BenchTable& table) {
    nlohmann::json rows = nlohmann::json::array();
    for (const auto& row : table.rows) {
        nlohmann::json object;
        for (std::size_t n = 0; n < row.size(); ++n) {
            object[table.keys[n]] = row[n];
        }
        rows.push_back(std::move(object));
    }
    return rows;
}

std::string html_of(const BenchTable& table) {
    std::string text = "<div class=\"wide\"><table><thead><tr>";
    for (const std::string& heading : table.headings) {
        text += heading.empty() ? "" : "<th>" + html_text(heading);
    }
    text += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
        text += "<tr>";
        for (std::size_t n = 0; n < row.size(); ++n) {
            text += table.headings[n].empty() ? "" : "<td>" + html_cell(row[n], table.formats[n]);
        }
        text += "</tr>\n";
    }
    return text + "</tbody></table></div>\n";
}

std::string folded_html_of(const BenchTable& table) {
    return "<details><summary>All numbers</summary>\n" + html_of(table) + "</details>";
}

std::string machine_html(const Machine& machine) {
    return fmt::format("{}, {} cores; {} ({}). Bruma {}, {}.", html_text(machine.cpu), machine.cores,
                       html_text(machine.renderer), html_text(machine.driver), machine.version, machine.date);
}

void write_bench_files(const std::filesystem::path& folder, const std::vector<BenchFile>& files) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);  // a folder that cannot be is told by the first file in it
    for (const BenchFile& file : files) {
        io::write_file_atomically(folder / file.name, file.text);
    }
}

}  // namespace bruma::measure
