#include "model/terrain/reading_notes.hpp"

namespace yars::model::terrain {

namespace {

std::vector<std::string> new_sentences(const std::filesystem::path& path, const std::vector<std::string>& warnings,
                                       std::set<std::string>& said) {
  std::vector<std::string> sentences;
  for (const std::string& warning : warnings) {
    std::string sentence = path.string() + ": " + warning;
    if (said.insert(sentence).second) sentences.push_back(std::move(sentence));
  }
  return sentences;
}

void append(std::vector<std::string> more, std::vector<std::string>& sentences) {
  for (std::string& sentence : more) sentences.push_back(std::move(sentence));
}

}  // namespace

std::vector<std::string> ReadingNotes::heard(const std::filesystem::path& path, const CellReading& reading) {
  std::vector<std::string> sentences;
  for (const std::string& warning : reading.warnings) sentences.push_back(path.string() + ": " + warning);
  append(new_sentences(path, reading.file_warnings, said_), sentences);
  if (reading.impossible > 0 && said_.insert(path.string()).second)
    sentences.push_back(path.string() + ": " + impossible_heights_warning(reading.impossible));
  return sentences;
}

void AllReadingNotes::add(const std::filesystem::path& path, const CellReading& reading) {
  for (const std::string& warning : reading.warnings) sentences_.push_back(path.string() + ": " + warning);
  add_file(path, reading.file_warnings, reading.impossible);
}

void AllReadingNotes::add_file(const std::filesystem::path& path, const std::vector<std::string>& warnings,
                               std::size_t impossible) {
  append(new_sentences(path, warnings, said_), sentences_);
  if (impossible > 0) impossible_[path.string()] += impossible;
}

std::vector<std::string> AllReadingNotes::sentences() const {
  std::vector<std::string> sentences = sentences_;
  for (const auto& [path, posts] : impossible_) sentences.push_back(path + ": " + impossible_heights_warning(posts));
  return sentences;
}

}  // namespace yars::model::terrain
