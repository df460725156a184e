"""The picture in a browser. Needs NiceGUI, which brings three.js; nothing comes from the network.

picture     the element on a page; `picture.js` beside it draws
delivery    the bytes of lines over HTTP
"""
