"""The list of parts of a release in SPDX 2.3 (JSON): its files, the Debian packages that they depend on, the npm
packages that build and test the pages of the station. Equal input gives equal text."""
import hashlib
import json
import re
import time
import urllib.parse
import uuid

from debian_parts import SPDX_OF_DEBIAN

UNKNOWN = "NOASSERTION"
# Words of Debian -> relation of SPDX. An optional one is a relation of the part to the file.
OPTIONAL = {"Depends": False, "Recommends": True, "Suggests": True}


def identifier(*words):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", "-".join(words))


def package(name, version, spdx_id, licence=UNKNOWN, **more):
    known = {"versionInfo": version} if version else {}
    return {"name": name, "SPDXID": spdx_id, **known, "downloadLocation": UNKNOWN, "filesAnalyzed": False,
            "licenseConcluded": UNKNOWN, "licenseDeclared": licence, "copyrightText": UNKNOWN, **more}


def reference(kind, name, version, **qualifiers):
    """An external reference: the package URL."""
    place = f"pkg:{kind}/{urllib.parse.quote(name, safe='/')}@{urllib.parse.quote(version, safe='')}"
    if qualifiers:
        place += "?" + urllib.parse.urlencode(sorted(qualifiers.items()))
    return [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": place}]


def debian_package(part, system):
    identifiers = [SPDX_OF_DEBIAN.get(name) for name in part["licences"]]
    licence = " AND ".join(sorted(set(identifiers))) if identifiers and all(identifiers) else UNKNOWN
    more = {"supplier": f"Organization: {system.partition('-')[0].capitalize()}"}
    if part["licences"]:
        more["licenseComments"] = "The package's copyright file names: " + "; ".join(part["licences"])
    if part["version"]:
        more["externalRefs"] = reference("deb", f"{system.partition('-')[0]}/{part['name']}", part["version"],
                                         distro=system)
        more["sourceInfo"] = f"source package {part['source']} {part['source_version']}"
    return package(part["name"], part["version"], identifier("Debian", system, part["name"]), licence, **more)


def npm_packages(lock):
    """Packages of package-lock.json."""
    for place, entry in sorted(lock["packages"].items()):
        if not place:
            continue
        name = place.rpartition("node_modules/")[2]
        yield package(name, entry["version"], identifier("npm", name, entry["version"]), entry.get("license", UNKNOWN),
                      externalRefs=reference("npm", name, entry["version"]),
                      comment="Builds or tests the pages of the station; no part of it is in them.")


def npm_faults(lock, licences):
    """Packages whose version or licence in package-lock.json is not that in LICENCES.md: one text each."""
    rows = {row[0]: row[1:] for row in re.findall(r"^\| (\S+) \| (\S+) \| (\S+) \|", licences, re.M)}
    for place, entry in sorted(lock["packages"].items()):
        name = place.rpartition("node_modules/")[2]
        row = rows.get(name) or rows.get(name.partition("/")[0] + "/*")
        if name and row != (entry["version"], entry.get("license")):
            yield (f"{name}: expected {entry['version']}, {entry.get('license')} as in package-lock.json, "
                   f"found {row or 'no row'}")


def relation(one, kind, other):
    return {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other}


class PartsList:
    def __init__(self, version):
        self.source = identifier("yars")
        self.packages = {self.source: package("yars", version, self.source, "MIT")}
        self.relations = [relation("SPDXRef-DOCUMENT", "DESCRIBES", self.source)]

    def add_file(self, name, content, version):
        """A file of the release; returns its identifier."""
        spdx_id = identifier("File", name)
        self.packages[spdx_id] = package(name, version, spdx_id, "MIT", packageFileName=name, checksums=[
            {"algorithm": "SHA256", "checksumValue": hashlib.sha256(content).hexdigest()}])
        self.relations.append(relation(spdx_id, "GENERATED_FROM", self.source))
        return spdx_id

    def add_debian(self, file_id, parts, system):
        """`parts` of a .deb by strength."""
        for strength, optional in OPTIONAL.items():
            for part in parts[strength]:
                entry = debian_package(part, system)
                self.packages[entry["SPDXID"]] = entry
                self.relations.append(relation(entry["SPDXID"], "OPTIONAL_DEPENDENCY_OF", file_id) if optional else
                                      relation(file_id, "DEPENDS_ON", entry["SPDXID"]))

    def add_npm(self, lock):
        for entry in npm_packages(lock):
            self.packages[entry["SPDXID"]] = entry
            self.relations.append(relation(entry["SPDXID"], "DEV_DEPENDENCY_OF", self.source))

    def text(self, version, commit, seconds):
        """The list as JSON. `seconds`: date of the commit."""
        document = {
            "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": f"yars-{version}",
            "documentNamespace": f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_OID, f'yars {version} {commit}')}",
            "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds)),
                             "creators": [f"Tool: yars-scripts-release-{version}"]},
            "packages": [self.packages[key] for key in sorted(self.packages)],
            "relationships": sorted(self.relations, key=lambda one: list(one.values())),
        }
        return json.dumps(document, indent=1, ensure_ascii=False) + "\n"
