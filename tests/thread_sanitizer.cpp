// Options of the thread sanitizer, for every test program. Only that build has this file.

// libstdc++ is built without the sanitizer, so the sanitizer does not see the reference count of an exception_ptr. It reports a
// false race if one thread frees an exception that another thread has read. The reader still had a reference at that time.
extern "C" char const* __tsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier): the sanitizer's own name
extern "C" char const* __tsan_default_suppressions() { return "race:std::__exception_ptr::exception_ptr::_M_release\n"; }
