/* Unpacks the modules of the viewer, which the page holds compressed, and starts it. */
(async () => {
   const packed = document.getElementById("litz-modules").textContent;
   const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
   const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
   const modules = JSON.parse(await new Response(stream).text());
   const imports = {};
   for (const [name, text] of Object.entries(modules)) imports[name] = `data:text/javascript,${encodeURIComponent(text)}`;
   const map = document.createElement("script");
   map.type = "importmap";
   map.textContent = JSON.stringify({ imports });
   document.head.append(map);
   const start = document.createElement("script");
   start.type = "module";
   start.textContent = 'import "litz/viewer.js";';
   document.head.append(start);
})();
