#include "measure/bench/bench_html.h"

#include <fmt/core.h>

#include "measure/bench/plot.h"

namespace bruma::measure {

std::string page_head(const std::string& title, const std::string& heading) {
    return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
           "<meta name=\"viewport\" content=\"width=device-width\">"
           "<title>" +
           html_text(title) + "</title>\n<style>\n" + plot_style() +
           R"(body{background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,sans-serif;margin:0 auto;
padding:1.5rem;max-width:1240px}
h1,h2,h3{line-height:1.2;margin:1.4rem 0 .5rem}h1{font-size:1.7rem}h3{font-size:1rem;margin:.2rem 0 .6rem}
p{max-width:80ch}.soft{color:var(--soft)}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,460px),1fr));gap:1.2rem}
figure{margin:0;border:1px solid var(--grid);border-radius:6px;padding:1rem;display:flex;flex-direction:column}
figure svg{margin:auto 0}figcaption{margin-top:.6rem;font-size:.92rem}figcaption::first-letter{text-transform:uppercase}
summary{cursor:pointer;margin:1rem 0 .5rem}.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.8rem;font-variant-numeric:tabular-nums;white-space:nowrap}
th,td{padding:.15rem .55rem;text-align:right;border-bottom:1px solid var(--grid)}th{text-align:right;color:var(--soft)}
th:first-child,td:first-child{text-align:left}tbody tr:hover{background:var(--grid)}
</style></head><body>
<h1>)" + html_text(heading) +
           "</h1>\n";
}

std::string figure(const std::string& title, const std::string& svg, const std::string& finding) {
    return fmt::format("<figure><h3>{}</h3>\n{}<figcaption>{}.</figcaption></figure>\n", html_text(title), svg,
                       html_text(finding));
}

}  // namespace bruma::measure
