// SPDX-License-Identifier: MIT
// Files that crash or hang a widespread reader (Coin 4.0): each must be read or refused within ten seconds of
// processor time and a gigabyte of memory, which the system holds us to in a process of its own.
#include <csignal>
#include <functional>
#include <sys/resource.h>

#include "readers/mesh/model_samples.hpp"
#include "readers/vrml/vrml_text.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TRIBO_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TRIBO_SANITIZED
#endif
#endif

namespace tribo::readers {
namespace {

using test::kHeader;
using test::kTriangle;

constexpr const char* kRead = "";  // no refusal

std::string repeated(const std::string& text, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += text;
    return out;
}

// N0 is `body`; each further name shows the one before twice.
std::string doubled(const std::string& body, const std::string& open, const std::string& close, int times) {
    std::string text = kHeader + open + "N0" + body;
    for (int i = 1; i <= times; ++i) {
        const std::string below = "N" + std::to_string(i - 1);
        text += open + "N" + std::to_string(i) + close;
        for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@'))
            text.replace(at, 1, below);
    }
    return text;
}

struct Trap {
    const char* what;
    std::function<std::string()> make;
    const char* cause;
    std::function<std::string()> other = {};  // the file that it names; absent: itself
};

const Trap kTraps[] = {
    {"a file that shows itself", [] { return kHeader + "Inline { url \"self.wrl\" }"; }, "names itself"},
    {"USE of the node that it stands in", [] { return kHeader + "DEF A Group { children USE A }"; },
     "USE of 'A'"},
    {"a prototype of itself", [] { return kHeader + "PROTO P [ ] { Group { children P { } } }\nP { }"; },
     "the prototype 'P' contains itself"},
    {"prototypes of each other",
     [] { return kHeader + "PROTO A [ ] { B { } }\nPROTO B [ ] { A { } }\nB { }\n" + kTriangle; }, kRead},
    {"prototypes of each other, one in the other",
     [] { return kHeader + "PROTO A [ ] { PROTO B [ ] { A { } } B { } }\nA { }"; },
     "the prototype 'A' contains itself"},
    {"20,000 nested groups", [] { return kHeader + repeated("Group { children [ ", 20'000); },
     "more than 256 deep"},
    {"20,000 nested brackets of an unknown node", [] { return kHeader + "X {" + repeated("[ ", 20'000); },
     "the file ends"},
    {"20,000 nested prototypes", [] { return kHeader + repeated("PROTO P [ ] { ", 20'000); },
     "more than 256 deep"},
    {"a name of 300 kB", [] { return kHeader + "DEF " + std::string(300'000, 'n') + " Group { }"; },
     "longer than 64 kB"},
    {"a number of 300 kB",
     [] { return kHeader + "Transform { translation " + std::string(300'000, '7') + " 0 0 }"; },
     "longer than 64 kB"},
    {"a hexadecimal number of 5 kB",
     [] { return kHeader + "Switch { whichChoice 0x" + std::string(5'000, 'f') + " choice Group { } }"; },
     "expected"},
    {"index 2147483647",
     [] {
         std::string text = kTriangle;
         text.replace(text.find("0 1 2 -1"), 8, "0 1 2147483647 -1");
         return kHeader + text;
     },
     "not one of the 3"},
    {"nodes of a wrong kind",
     [] {
         return kHeader +
                "Shape { appearance Box { } geometry IndexedFaceSet { coord Color { color [ 0 0 0 ] } color "
                "Group { "
                "} coordIndex [ 0 ] } }";
     },
     "'coord' must be a Coordinate"},
    {"27 doublings by USE",
     [] {
         return doubled(" Group { children " + kTriangle + "}\n", "DEF ",
                        " Group { children [ USE @ USE @ ] }\n", 27);
     },
     "4 million nodes"},
    {"200 doublings by USE of many triangles",
     [] {
         std::string many = kTriangle;
         many.replace(many.find("0 1 2 -1"), 8, repeated("0 1 2 -1 ", 4000));
         return doubled(" Group { children " + many + "}\n", "DEF ", " Group { children [ USE @ USE @ ] }\n",
                        200);
     },
     "20000000 triangles"},
    {"30 doublings by prototypes",
     [] {
         return doubled(" [ ] { " + kTriangle + "}\n", "PROTO ",
                        " [ ] { Group { children [ @ { } @ { } ] } }\n", 30) +
                "N30 { }";
     },
     "prototypes unfold to more than 4 million"},
    {"100 prototypes in each other",
     [] { return doubled(" [ ] { " + kTriangle + "}\n", "PROTO ", " [ ] { @ { } }\n", 100) + "N100 { }"; },
     "prototypes stand within prototypes more than 32 deep"},
    {"2 million prototypes' instances",
     [] {
         return kHeader + "PROTO P [ ] { Group { children [ " + repeated("Group { } ", 1000) + "] } }\n" +
                repeated("P { }\n", 2000);
     },
     "prototypes unfold to more than 4 million"},
    {"a grid of a billion points",
     [] {
         return kHeader +
                "Shape { geometry ElevationGrid { xDimension 1000000 zDimension 1000000 height [ 0 ] } }";
     },
     "20000000 triangles"},
    {"an extrusion of a hundred million sides",
     [] {
         return kHeader + "Shape { geometry Extrusion { crossSection [ " + repeated("0 1 1 0 ", 5'000) +
                "] spine [ " + repeated("0 0 0 0 1 0 ", 5'000) + "] } }";
     },
     "20000000 triangles"},
    {"a prototype of 50,000 fields, all of them given",
     [] {
         std::string text = kHeader + "PROTO P [ ", given = "P { ";
         for (int i = 0; i < 50'000; ++i) {
             text += "field SFInt32 f" + std::to_string(i) + " 0 ";
             given += "f" + std::to_string(i) + " 1 ";
         }
         return text + "] { " + kTriangle + "}\n" + given + "}";
     },
     "declares more than 1000 fields"},
    {"20,000 instances that name 10,000 files each",
     [] {
         return kHeader + "PROTO P [ field MFString u [ " + repeated("\"a.wrl\" ", 10'000) +
                "] ] { Inline { url IS u } }\n" + repeated("P { }\n", 20'000);
     },
     "names more than 100 files"},
    {"200,000 Inline nodes that are refused",
     [] { return kHeader + repeated("Inline { url \"self.wrl\" }\n", 200'000); }, "names itself"},
    {"20,000 Inline nodes of 20,000 nodes",
     [] { return kHeader + repeated("Inline { url \"b.wrl\" }\n", 20'000); },
     "more than 20000000 children of nodes", [] { return kHeader + repeated("Group { }\n", 20'000); }},
    {"20,000 instances with one list of 20,000 nodes",
     [] {
         return kHeader + "PROTO P [ field MFNode c [ " + repeated("Group { } ", 20'000) +
                "] ] { Group { children IS c } }\n" + repeated("P { }\n", 20'000);
     },
     "more than 20000000 children of nodes"},
    {"a triangle beside 20,000 empty nodes, used 20,000 times",
     [] {
         return kHeader + "DEF G Group { children [ " + kTriangle + repeated("Group { } ", 20'000) + "] }\n" +
                repeated("USE G\n", 20'000);
     },
     "4 million nodes"},
    {"10,000 instances with one list of 100,000 indices",
     [] {
         return kHeader + "PROTO P [ field MFInt32 i [ " + repeated("-1 ", 100'000) +
                "] ] { Shape { geometry IndexedFaceSet { coordIndex IS i } } }\n" +
                repeated("P { }\n", 10'000);
     },
     "more than 50000000 indices"},
    {"50,000 shapes with a material of 100,000 colours",
     [] {
         return kHeader + "Group { children [ DEF S " + kTriangle +
                "Shape { appearance Appearance { material DEF M Material { diffuseColor [ " +
                repeated("1 0 0 ", 100'000) + "] } } geometry Box { } } ] }\n" +
                repeated("Shape { appearance Appearance { material USE M } geometry Box { } }\n", 50'000);
     },
     kRead},
    {"20,000 prototypes out of a file of 20,000",
     [] { return kHeader + repeated("EXTERNPROTO X [ ] \"b.wrl#A19999\"\n", 20'000) + kTriangle; }, kRead,
     [] {
         std::string text = kHeader;
         for (int i = 0; i < 20'000; ++i) text += "PROTO A" + std::to_string(i) + " [ ] { }\n";
         return text;
     }},
    {"10,000 spheres", [] { return kHeader + repeated("Shape { geometry Sphere { } }\n", 10'000); },
     "20000000 triangles"},
};

// Ends the process with 0 where the reader did as it should.
[[noreturn]] void read_within_limits(const Trap& trap) {
    const std::string bytes = trap.make();
#ifndef TRIBO_SANITIZED
    // A tenth of that on a machine at rest: what hangs takes minutes.
    const rlimit time{10, 10}, memory{rlim_t{1} << 30, rlim_t{1} << 30};
    setrlimit(RLIMIT_CPU, &time);
    setrlimit(RLIMIT_AS, &memory);
#endif
    ModelOptions options;
    options.source_name = "self.wrl";
    options.neighbours = [&](std::string_view, const std::string&, std::uint64_t) -> Result<ModelNeighbour> {
        if (trap.other) return ModelNeighbour{"b.wrl", trap.other()};
        return ModelNeighbour{"self.wrl", {}};
    };
    const auto model = read_model(bytes, options);
    const std::string cause = model ? "" : model.error().cause;
    std::fprintf(stderr, "[%s]", cause.c_str());
    const bool as_said =
        *trap.cause == '\0' ? model.has_value() : cause.find(trap.cause) != std::string::npos;
    std::_Exit(as_said ? 0 : 1);
}

TEST(VrmlLimitsDeathTest, FilesThatCrashOrHangOthersCostSecondsAtMost) {
    for (const Trap& trap : kTraps) {
        SCOPED_TRACE(trap.what);
        EXPECT_EXIT(read_within_limits(trap), testing::ExitedWithCode(0), "");
    }
}

}  // namespace
}  // namespace tribo::readers
