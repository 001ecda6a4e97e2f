#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Assimp 5.2.5 (Debian 12) and an IFC in surveyed coordinates: it turns Z up to Y up with a matrix of floats whose zero is
# 4.4e-8, and keeps each body's place in floats. At 5,334,567 m north everything comes out 23 cm too low, and of two blocks that
# touch, each with a placement of its own, one ends 0.2 m from the other: north is stored in steps of half a metre. At the
# origin both are right. What moves such models before it converts them, as web-ifc's COORDINATE_TO_ORIGIN does, avoids it.
#
# Seen: assimp-utils and libassimp5 5.2.5~ds0-1+b1. Needs apt, dpkg, python3.
set -euo pipefail

version=5.2.5~ds0-1+b1
expected='origin: height 0.000, gap 0.000; surveyed: height -0.233, gap 0.200'

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
echo "deb ${mirror:-https://deb.debian.org/debian} bookworm main" >sources.list
mkdir -p state/lists/partial cache/archives/partial
apt=(-o Dir::State="$folder/state" -o Dir::Cache="$folder/cache" -o Dir::Etc::SourceList="$folder/sources.list"
    -o Dir::Etc::SourceParts=/dev/null -o APT::Sandbox::User=root -qq)
apt-get "${apt[@]}" update
apt-get "${apt[@]}" download "assimp-utils=$version" "libassimp5=$version" libdraco7 libminizip1
for package in *.deb; do dpkg-deb -x "$package" root; done

cat >blocks.py <<'END'
import json, struct, subprocess, sys

def blocks(east, north, height):
    """Two blocks, 0.8 m deep, that touch, each with a placement of its own in the project's coordinates."""
    ifc = ["#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);", "#2=IFCUNITASSIGNMENT((#1));", "#3=IFCCARTESIANPOINT((0.,0.,0.));",
           "#4=IFCAXIS2PLACEMENT3D(#3,$,$);", "#5=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#4,$);",
           "#6=IFCPROJECT('0000000000000000000001',#44,'P',$,$,$,$,(#5),#2);",
           "#9=IFCLOCALPLACEMENT($,#4);",
           "#10=IFCSITE('0000000000000000000002',#44,'S',$,$,#9,$,$,.ELEMENT.,$,$,$,$,$);",
           "#11=IFCRELAGGREGATES('0000000000000000000003',#44,$,$,#6,(#10));",
           "#12=IFCCARTESIANPOINT((0.,0.));", "#13=IFCAXIS2PLACEMENT2D(#12,$);",
           "#14=IFCRECTANGLEPROFILEDEF(.AREA.,$,#13,1.,0.8);", "#15=IFCDIRECTION((0.,0.,1.));",
           "#16=IFCEXTRUDEDAREASOLID(#14,#4,#15,1.);",
           "#17=IFCSHAPEREPRESENTATION(#5,'Body','SweptSolid',(#16));", "#18=IFCPRODUCTDEFINITIONSHAPE($,$,(#17));"]
    for i in range(2):
        n = 20 + 10 * i
        ifc += [f"#{n}=IFCCARTESIANPOINT(({east},{north + 0.8 * i},{height}));", f"#{n+1}=IFCAXIS2PLACEMENT3D(#{n},$,$);",
                f"#{n+2}=IFCLOCALPLACEMENT($,#{n+1});",
                f"#{n+3}=IFCBUILDINGELEMENTPROXY('000000000000000000001{i}',#44,'B{i}',$,$,#{n+2},#18,$,$);"]
    ifc += ["#40=IFCPERSON($,'A',$,$,$,$,$,$);", "#41=IFCORGANIZATION($,'A',$,$,$);",
            "#42=IFCPERSONANDORGANIZATION(#40,#41,$);", "#43=IFCAPPLICATION(#41,'1','A','A');",
            "#44=IFCOWNERHISTORY(#42,#43,$,.ADDED.,$,$,$,0);",
            "#50=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000004',#44,$,$,(#23,#33),#10);"]
    return ("ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
            "FILE_SCHEMA(('IFC2X3'));\nENDSEC;\nDATA;\n" + "\n".join(ifc) + "\nENDSEC;\nEND-ISO-10303-21;\n")

def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]

def boxes(file):
    """Of each mesh: low and high corner in the world, in doubles."""
    data = open(file, "rb").read()
    gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
    found = []
    def visit(index, world):
        node = gltf["nodes"][index]
        if "matrix" in node:
            m = node["matrix"]
            world = product(world, [[m[4 * j + i] for j in range(4)] for i in range(4)])
        if "mesh" in node:
            for primitive in gltf["meshes"][node["mesh"]]["primitives"]:
                accessor = gltf["accessors"][primitive["attributes"]["POSITION"]]
                corners = [[(accessor["min"], accessor["max"])[(k >> i) & 1][i] for i in range(3)] + [1] for k in range(8)]
                points = [[sum(world[i][k] * c[k] for k in range(4)) for i in range(3)] for c in corners]
                found.append(([min(p[i] for p in points) for i in range(3)], [max(p[i] for p in points) for i in range(3)]))
        for child in node.get("children", []):
            visit(child, world)
    for root in gltf["scenes"][gltf.get("scene", 0)]["nodes"]:
        visit(root, [[float(i == j) for j in range(4)] for i in range(4)])
    return found

said = []
for name, place in (("origin", (0.0, 0.0, 0.0)), ("surveyed", (691234.5, 5334567.5, 519.25))):
    open(name + ".ifc", "w").write(blocks(*place))
    subprocess.run([sys.argv[1], "export", name + ".ifc", name + ".glb", "-fglb2"], check=True, stdout=subprocess.DEVNULL)
    first, second = sorted(boxes(name + ".glb"), key=lambda box: -box[0][2])
    height, gap = first[0][1] - place[2], first[0][2] - second[1][2]
    said.append(f"{name}: height {height + 0:.3f}, gap {gap + 0:.3f}".replace("-0.000", "0.000"))
print("; ".join(said))
END
export LD_LIBRARY_PATH=$folder/root/usr/lib/x86_64-linux-gnu
said=$(python3 blocks.py root/usr/bin/assimp)
echo "$said"
[ "$said" = "$expected" ] || { echo "changed: expected $expected" >&2; exit 1; }
