// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The look of the programs' pages. The one stylesheet stands in each page, so that a page is one file beside its
// plots and loads nothing; start_page.cmake reads the stylesheet from here as well.

#include "claims.hpp"
#include "text.hpp"

#include <string>
#include <vector>

namespace experiments {

/// Text has a contrast of 7 or more in both schemes, what is muted 4.5 or more.
inline constexpr const char* page_style = R"css(
:root{color-scheme:light dark;--ink:#1b1f24;--soft:#57606a;--line:#d5dae0;--paper:#fff;--raised:#f6f7f8;--link:#0a58b5}
@media (prefers-color-scheme:dark){:root{--ink:#e4e8ec;--soft:#9da7b1;--line:#353c45;--paper:#15191e;--raised:#1b2026;--link:#79b0f5}}
*{box-sizing:border-box}
html{scroll-behavior:smooth;scroll-padding-top:1rem;-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:1rem/1.6 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans",sans-serif}
a{color:var(--link);text-underline-offset:.15em}
a:focus-visible,div:focus-visible{outline:2px solid var(--link);outline-offset:2px}
header,main,nav,footer{max-width:58rem;margin:0 auto;padding:0 1.25rem}
header{padding-top:2.5rem}
h1{font-size:clamp(1.5rem,5vw,2.1rem);line-height:1.2;margin:0 0 .75rem;letter-spacing:-.015em}
h2{font-size:1.35rem;line-height:1.3;margin:3.25rem 0 .75rem;padding-top:1.25rem;border-top:1px solid var(--line)}
p{max-width:44rem;margin:.75rem 0;overflow-wrap:anywhere}
header p{color:var(--soft)}
nav h2{font-size:.8rem;letter-spacing:.06em;text-transform:uppercase;color:var(--soft);margin:0 0 .25rem;padding:0;border:0}
nav div{background:var(--raised);border:1px solid var(--line);border-radius:.5rem;margin-top:1.5rem;padding:1rem 1.25rem}
nav ol{margin:0;padding-left:1.4rem}
nav ol ol{list-style:none;padding-left:.5rem;font-size:.9rem}
nav li{margin:.15rem 0}
.scroll{overflow-x:auto;margin:1.25rem 0}
table{border-collapse:collapse;font-size:.9rem;line-height:1.4;font-variant-numeric:tabular-nums}
th,td{padding:.35rem .75rem;text-align:left;vertical-align:baseline;border-bottom:1px solid var(--line)}
th{color:var(--soft);font-weight:600;vertical-align:bottom;border-bottom:2px solid var(--line)}
td.n,th.n{text-align:right;white-space:nowrap}
th:first-child,td:first-child{padding-left:0}
tbody tr:hover{background:var(--raised)}
figure{margin:2rem 0;padding:1rem 1.25rem 1.1rem;background:var(--raised);border:1px solid var(--line);border-radius:.5rem}
figure .scroll{margin:0 0 .5rem}
figure img{display:block;width:100%;min-width:34rem;height:auto}
figcaption{max-width:44rem;font-size:.92rem;line-height:1.5;color:var(--soft)}
figcaption b{display:block;color:var(--ink)}
.warning{border-left:.25rem solid #d4552a;padding:.5rem 1rem;background:var(--raised)}
.cards{list-style:none;margin:1.5rem 0;padding:0;display:grid;gap:1rem;grid-template-columns:repeat(auto-fill,minmax(min(100%,17rem),1fr))}
.cards a{display:block;height:100%;padding:1rem 1.25rem;background:var(--raised);border:1px solid var(--line);border-radius:.5rem;color:inherit;text-decoration:none}
.cards a:hover{border-color:var(--link)}
.cards b{display:block;color:var(--link)}
.cards span{font-size:.9rem;color:var(--soft)}
footer{margin-top:3rem;padding-top:1rem;padding-bottom:2.5rem;font-size:.9rem;color:var(--soft)}
@media print{nav{display:none}figure,table{break-inside:avoid}}
)css";

/// The style of the plots: black becomes the text colour of the scheme, and the background that of the page. The
/// colours of the curves have a contrast of 3 or more in both schemes.
inline constexpr const char* plot_style = R"css(<style>
:root{color-scheme:light dark;--ink:#1b1f24;--grid:#8a929b}
@media (prefers-color-scheme:dark){:root{--ink:#e4e8ec;--grid:#69727c}}
[color=black]{color:var(--ink)}[stroke=black]{stroke:var(--ink)}[fill=black]{fill:var(--ink)}
.gridline{stroke:var(--grid);stroke-width:.6}
text{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans",sans-serif}
</style>
)css";

/// The commands before those of every plot. Line types 1 to 8 are the palette, 9 to 16 the same dashed; black
/// (`lt -1`) is the text colour, grey is 8.
inline constexpr const char* plot_preamble =
    "set terminal svg size 760,430 dynamic font 'sans-serif,14'\n"
    "palette = '#3b7dd8 #d4552a #2e9a5b #8a63d2 #b8860b #1a8f9c #c0417a #808890'\n"
    "do for [i=1:8] {\nset linetype i lc rgb word(palette, i) lw 1.8 pt i + 3 ps 0.6\n"
    "set linetype i + 8 lc rgb word(palette, i) lw 1.8 pt i + 3 ps 0.6 dt 2\n}\n"
    "set linetype cycle 16\n"
    "set datafile separator ','\nset encoding utf8\n"
    "set key autotitle columnhead\nset key below noenhanced samplen 2\n"
    "set grid\nset border 3\nset tics nomirror\n";

/// Makes the identifier of a heading: its letters and digits, joined by hyphens, unlike all identifiers before.
class anchors {
 public:
  std::string of(const std::string& text) {
    std::string id;
    for (const char c : text) {
      const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
      if (plain || (c >= 'A' && c <= 'Z')) {
        id += static_cast<char>(plain ? c : c - 'A' + 'a');
      } else if (!id.empty() && id.back() != '-') {
        id += '-';
      }
    }
    while (!id.empty() && id.back() == '-') id.pop_back();
    if (id.empty()) id = "section";
    std::string found = id;
    for (int n = 2; std::find(taken_.begin(), taken_.end(), found) != taken_.end(); ++n) {
      found = id + "-" + std::to_string(n);
    }
    taken_.push_back(found);
    return found;
  }

 private:
  std::vector<std::string> taken_;
};

/// Collects a page: sections, tables and figures, and the table of contents above them.
class page {
 public:
  void section(const std::string& title, const std::string& text) {
    const std::string id = anchors_.of(title);
    sections_.push_back({id, title, {}});
    body_ +=
        "<h2 id=\"" + id + "\">" + html_text(title) + "</h2>\n<p>" + html_text(text) + "</p>\n";
  }
  void show(const table& t) {
    body_ += "<div class=\"scroll\" tabindex=\"0\">" + t.html() + "</div>\n";
  }
  void figure(const std::string& name, const caption& said) {
    const std::string id = anchors_.of("figure " + name);
    if (sections_.empty()) sections_.push_back({"", "Figures", {}});
    sections_.back().figures.emplace_back(id, said.title);
    body_ += "<figure id=\"" + id + "\"><div class=\"scroll\" tabindex=\"0\"><img src=\"" +
             html_text(name) + ".svg\" alt=\"" + attribute(said.title) +
             "\" width=\"760\" height=\"430\"></div><figcaption><b>" + html_text(said.title) +
             "</b> " + html_text(text_of(said.see)) + "</figcaption></figure>\n";
  }

  /// The whole page; `files` are listed at its end.
  [[nodiscard]] std::string html(const std::string& title, const std::string& lead, bool drawn,
                                 const std::vector<std::string>& files) const {
    std::string text =
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    text += "<title>" + html_text(title) + "</title>\n";
    if (!lead.empty()) {
      text += "<meta name=\"description\" content=\"" + attribute(lead) + "\">\n";
    }
    text += std::string("<style>") + page_style + "</style>\n</head>\n<body>\n";
    text += "<header>\n<h1>" + html_text(title) + "</h1>\n";
    if (!lead.empty()) text += "<p>" + html_text(lead) + "</p>\n";
    if (!drawn) {
      text += "<p class=\"warning\">Some plots are missing: gnuplot did not draw them.</p>\n";
    }
    text += "</header>\n" + contents() + "<main>\n" + body_ + "</main>\n<footer>\n<p>The figures ";
    text +=
        "are the program's own and its plots gnuplot's; what they are made of is in this folder";
    for (std::size_t i = 0; i < files.size(); ++i) {
      text += (i == 0 ? ": " : ", ") + ("<a href=\"" + attribute(files[i]) + "\">") +
              html_text(files[i]) + "</a>";
    }
    return text + ", and its CSV files.</p>\n</footer>\n</body>\n</html>\n";
  }

 private:
  struct entry {
    std::string id, title;
    std::vector<std::pair<std::string, std::string>> figures;  ///< identifier and title
  };

  static std::string attribute(const std::string& text) {
    return escaped(html_text(text), {{'"', "&quot;"}});
  }
  static std::string link(const std::string& id, const std::string& title) {
    if (id.empty()) return html_text(title);
    return "<a href=\"#" + id + "\">" + html_text(title) + "</a>";
  }
  [[nodiscard]] std::string contents() const {
    if (sections_.empty()) return "";
    std::string text = "<nav aria-label=\"Contents\"><div>\n<h2>Contents</h2>\n<ol>\n";
    for (const auto& s : sections_) {
      text += "<li>" + link(s.id, s.title);
      if (!s.figures.empty()) text += "\n<ol>\n";
      for (const auto& [id, title] : s.figures) text += "<li>" + link(id, title) + "</li>\n";
      text += s.figures.empty() ? "</li>\n" : "</ol></li>\n";
    }
    return text + "</ol>\n</div></nav>\n";
  }

  std::string body_;
  std::vector<entry> sections_;
  anchors anchors_;
};

}  // namespace experiments
