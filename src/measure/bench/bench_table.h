#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "measure/bench/bench_machine.h"

/// What the reports of all benches share: a table is listed once, by its columns, and written as CSV, JSON and HTML.
namespace bruma::measure {

/// One column: how it is called and what a row holds there. JSON makes null of numbers that are not finite.
template <class Row>
struct BenchColumn {
    std::string key;          ///< in CSV and JSON
    std::string heading;      ///< on the page; empty: not shown there
    std::string format = {};  ///< of numbers on the page, as "{:.3g}"; empty: as they are
    std::function<nlohmann::json(const Row&)> value;
};

struct BenchTable {
    std::vector<std::string> keys, headings, formats;
    std::vector<std::vector<nlohmann::json>> rows;
};

template <class Row>
BenchTable bench_table(const std::vector<BenchColumn<Row>>& columns, const std::vector<Row>& rows) {
    BenchTable table;
    for (const BenchColumn<Row>& column : columns) {
        table.keys.push_back(column.key);
        table.headings.push_back(column.heading);
        table.formats.push_back(column.format);
    }
    for (const Row& row : rows) {
        auto& cells = table.rows.emplace_back();
        for (const BenchColumn<Row>& column : columns) {
            cells.push_back(column.value(row));
        }
    }
    return table;
}

/// Tables of the same columns one below the other, behind a first column that says where each comes from.
BenchTable stacked(const std::string& key, const std::vector<std::pair<std::string, BenchTable>>& tables);

/// Numbers with six digits, yes and no as 1 and 0; words that are not plain in quotation marks.
std::string csv_of(const BenchTable& table);
/// An object for each row.
nlohmann::json json_of(const BenchTable& table);
std::string html_of(const BenchTable& table);
/// The same, folded up below the words 'All numbers'.
std::string folded_html_of(const BenchTable& table);

/// 'Xeon, 2 cores; llvmpipe (4.5). Bruma 0.1.0, 2024-05-01T12:00:00Z.'
std::string machine_html(const Machine& machine);

struct BenchFile {
    std::string name, text;
};
/// Writes files into a folder, which is made if need be; each appears whole or not at all.
void write_bench_files(const std::filesystem::path& folder, const std::vector<BenchFile>& files);

}  // namespace bruma::measure
