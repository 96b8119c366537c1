// bvh-compress' search for the form that holds a tree best: its options, and what it writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/output.h"
#include "trace/tune.h"

namespace bvhio {

/// Declare with the tool's own options; then parse, prepare, search.
class FormSearch {
  public:
    explicit FormSearch(CommandLine& line);
    /// Refuses options that exclude each other, and opens the table's file. `others` are options that have
    /// nothing to do with how nodes are stored: those that do are what the search chooses.
    void prepare(const CommandLine& line, const std::vector<std::string>& others);

    /// Whether candidates are to be measured at all.
    bool isWanted() const { return choosesForm() || !tablePath_.empty(); }
    /// Whether the form is to be chosen by a limit.
    bool choosesForm() const { return maxBytes_ >= 0 || maxSlowdown_ >= 0; }

    /// Measures the candidates, those of `form` alone when it is not empty, and writes the table. The chosen
    /// one, or null where no limit asks for one or none keeps it: then refusal() says so.
    const TunedEncoding* search(const Scene& scene, const Bvh& bvh, const std::string& form,
                                Progress& progress);
    /// One line: which limit nothing keeps, and what comes nearest.
    std::string refusal() const;

    /// Sets the chosen form and its parameters as if the command line had them: so provenance tells them.
    void assignTo(CommandLine& line) const;
    /// The command line's options as provenance tells them: without the search's where it chose nothing.
    Report recordedOptions(const CommandLine& line) const;
    /// For the pass' report: chosen, and candidates[] with the keys of the table.
    Report report() const;

  private:
    float maxBytes_ = -1, maxSlowdown_ = -1;
    uint32_t repeat_;
    uint64_t count_, seed_;
    std::string tablePath_;
    std::optional<Output> table_;
    std::vector<TunedEncoding> rows_;
    const TunedEncoding* chosen_ = nullptr;
};

}  // namespace bvhio
