document.title = "Served by a test";
