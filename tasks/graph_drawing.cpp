#include "tasks/graph_drawing.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string_view>
#include <vector>

#include "tasks/dependencies.hpp"

namespace aquagraph::tasks {

namespace {

// Light fills that black text can be read on, in the order in which families appear.
constexpr std::array<std::string_view, 12> palette = {"#a6cee3", "#b2df8a", "#fdbf6f", "#cab2d6", "#fb9a99", "#ffff99",
                                                      "#8dd3c7", "#d9d9d9", "#fccde5", "#bebada", "#ccebc5", "#e5d8bd"};
constexpr std::size_t lines_of_label = 3;  // more would push the nodes apart; the tooltip has all

std::string dot_text(std::string_view text) {
    std::string result = "\"";
    for (const char character : text) {
        if (character == '\n') {
            result += "\\n";
            continue;
        }
        if (character == '"' || character == '\\') result += '\\';
        result += character;
    }
    return result + '"';
}

std::string joined(const std::vector<std::string>& names) {
    std::string result;
    for (const std::string& name : names) result += (result.empty() ? "" : ", ") + name;
    return result.empty() ? "nothing" : result;
}

std::string_view short_name(HazardKind kind) {
    switch (kind) {
        case HazardKind::read_after_write:
            return "";
        case HazardKind::write_after_read:
            return " (WAR)";
        case HazardKind::write_after_write:
            return " (WAW)";
    }
    return "";
}

std::string node(std::size_t number, const Task& task, std::string_view colour) {
    std::ostringstream text;
    text << "t" << number << " [label=" << dot_text(task.name) << ", fillcolor=\"" << colour
         << "\", tooltip=" << dot_text("reads " + joined(task.reads) + "\nwrites " + joined(task.writes)) << "];\n";
    return text.str();
}

std::string edge_text(const Edge& edge, const DrawingOptions& options) {
    std::ostringstream label;
    std::ostringstream tooltip;
    for (std::size_t hazard = 0; hazard < edge.hazards.size(); ++hazard) {
        const Hazard& reason = edge.hazards[hazard];
        const char* const separator = hazard == 0 ? "" : "\n";
        tooltip << separator << reason.resource << ": " << to_string(reason.kind);
        if (hazard < lines_of_label) label << separator << reason.resource << short_name(reason.kind);
        if (hazard == lines_of_label) label << "\nand " << edge.hazards.size() - lines_of_label << " more";
    }
    std::ostringstream text;
    text << "t" << edge.from << " -> t" << edge.to << " [";
    if (options.edge_labels) text << "label=" << dot_text(label.str()) << ", ";
    text << "edgetooltip=" << dot_text(tooltip.str()) << ", labeltooltip=" << dot_text(tooltip.str());
    const bool data_flows = edge.hazards.front().kind == HazardKind::read_after_write;
    if (!data_flows) text << ", style=dashed, color=\"#808080\"";
    text << "];\n";
    return text.str();
}

}  // namespace

std::string to_dot(std::span<const Task> listing, const DrawingOptions& options) {
    std::map<std::string_view, std::string_view> colours;
    std::vector<std::string> nodes;
    std::vector<std::string_view> groups;  // in order of appearance
    for (std::size_t number = 0; number < listing.size(); ++number) {
        const Task& task = listing[number];
        const auto colour = colours.try_emplace(family_of(task.name), palette[colours.size() % palette.size()]).first;
        nodes.push_back(node(number, task, colour->second));
        if (std::find(groups.begin(), groups.end(), task.group) == groups.end()) groups.push_back(task.group);
    }

    const std::string legend = "solid: reads what was written    dashed: waits before it overwrites";
    std::string dot = "digraph tasks {\n";
    dot += "rankdir=TB; ranksep=0.35; nodesep=0.25; fontname=\"Helvetica\"; fontsize=11; labelloc=t;\n";
    dot += "label=" + dot_text(options.title.empty() ? legend : options.title + "\n" + legend) + ";\n";
    dot += "node [shape=box, style=\"rounded,filled\", fontname=\"Helvetica\", fontsize=11, height=0.3];\n";
    dot += "edge [fontname=\"Helvetica\", fontsize=8, fontcolor=\"#404040\", arrowsize=0.6];\n";
    for (std::size_t group = 0; group < groups.size(); ++group) {
        const bool framed = options.groups && !groups[group].empty();
        if (framed)
            dot += "subgraph cluster_" + std::to_string(group) + " {\nlabel=" + dot_text(groups[group]) +
                   "; labeljust=l; color=\"#b0b0b0\";\n";
        for (std::size_t number = 0; number < listing.size(); ++number)
            if (listing[number].group == groups[group]) dot += nodes[number];
        if (framed) dot += "}\n";
    }
    for (const Edge& edge : derive_edges(listing)) dot += edge_text(edge, options);
    return dot + "}\n";
}

}  // namespace aquagraph::tasks
