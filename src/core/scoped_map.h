// A map whose changes can be taken back: what a block of a scene file sets holds until the block ends. One map and a
// list of changes, so that a thousand blocks within each other don't keep a thousand maps.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace etd {

template <class Key, class Value>
class ScopedMap {
 public:
  // Sets or replaces.
  void set(const Key& key, Value value) {
    const auto [entry, is_new] = entries_.try_emplace(key);
    changes_.emplace_back(key, is_new ? std::nullopt : std::optional<Value>(std::move(entry->second)));
    entry->second = std::move(value);
  }
  // Null when there is none; until the next change.
  const Value* find(const Key& key) const {
    const auto entry = entries_.find(key);
    return entry == entries_.end() ? nullptr : &entry->second;
  }
  const std::map<Key, Value>& entries() const { return entries_; }

  // A moment to go back to.
  size_t mark() const { return changes_.size(); }
  void go_back(size_t mark) {
    for (; changes_.size() > mark; changes_.pop_back()) {
      auto& [key, before] = changes_.back();
      if (before)
        entries_[key] = std::move(*before);
      else
        entries_.erase(key);
    }
  }

 private:
  std::map<Key, Value> entries_;
  std::vector<std::pair<Key, std::optional<Value>>> changes_;
};

}  // namespace etd
