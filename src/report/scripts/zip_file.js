// Files as one .zip, stored as they are (PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", 4.3).
carom.zipFile = (function () {
  "use strict";
  const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
    let c = n;
    for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
    return c;
  });

  function crc32(bytes) {
    let c = 0xffffffff;
    for (const byte of bytes) c = TABLE[(c ^ byte) & 255] ^ (c >>> 8);
    return (c ^ 0xffffffff) >>> 0;
  }

  // Whole numbers of so many bytes each, the lowest byte first.
  const numbers = (...pairs) => Uint8Array.from(pairs.flatMap(([value, width]) => Array.from({ length: width }, (_, b) => Math.floor(value / 256 ** b) % 256)));
  const DATE = [33, 2];  // 1980-01-01: the same frames are the same file

  // What stands before a file and again in the list of all: version, flags, method, time, sizes.
  const entry = ({ name, bytes }) => numbers([10, 2], [0, 2], [0, 2], [0, 2], DATE, [crc32(bytes), 4], [bytes.length, 4], [bytes.length, 4], [name.length, 2], [0, 2]);

  // files: name (of ASCII letters) and bytes of each. The parts of the archive, one after the other.
  return function (files) {
    const text = new TextEncoder(), parts = [], list = [];
    let at = 0;
    for (const file of files) {
      const name = text.encode(file.name), known = entry(file);
      list.push(numbers([0x02014b50, 4], [20, 2]), known, numbers([0, 2], [0, 2], [0, 2], [0, 4], [at, 4]), name);
      parts.push(numbers([0x04034b50, 4]), known, name, file.bytes);
      at += 4 + known.length + name.length + file.bytes.length;
    }
    const size = list.reduce((sum, part) => sum + part.length, 0);
    return [...parts, ...list, numbers([0x06054b50, 4], [0, 2], [0, 2], [files.length, 2], [files.length, 2], [size, 4], [at, 4], [0, 2])];
  };
})();
